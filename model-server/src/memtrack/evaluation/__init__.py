# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of detection and tracking against a ground truth."""
