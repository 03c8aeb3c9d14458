# SPDX-License-Identifier: GPL-3.0-or-later
"""The checker that holds every call within `memtrack` to the types and array shapes of its signature during tests."""

from beartype import BeartypeConf, beartype

# As for a type checker, an int will do for a float.
check = beartype(conf=BeartypeConf(is_pep484_tower=True))
