# SPDX-License-Identifier: GPL-3.0-or-later
"""How well the whole method and what else there is do on fixed films that no training and no tuning has seen."""
