# SPDX-License-Identifier: GPL-3.0-or-later
"""MEMTrack: multi-level detection of bacteria and microrobots in films of dense, low-contrast media."""

__version__ = "0.1.0"
