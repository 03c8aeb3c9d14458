# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulated films, training of the detectors and choice of their thresholds."""
