# SPDX-License-Identifier: GPL-3.0-or-later
"""The subcommands of the `memtrack` command, one module each: `add_arguments(parser)` and `run(args) -> int`."""
