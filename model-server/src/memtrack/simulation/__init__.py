# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulated films of bacteria with exact truth: how they swim, how a microscope shows them, and in front of what."""
