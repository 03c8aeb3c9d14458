# SPDX-License-Identifier: GPL-3.0-or-later
"""File formats of tracks; `memtrack.tracks_io` is the way in."""
