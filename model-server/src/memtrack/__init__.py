# SPDX-License-Identifier: GPL-3.0-or-later
"""MEMTrack: multi-level detection of bacteria and microrobots in films of dense, low-contrast media."""

import os
import sys

__version__ = "0.1.0"

if sys.platform == "win32":
    # Where msvc-runtime lays Microsoft's C++ library. Windows itself looks beside the program that runs, in a venv the
    # Python it was made with.
    os.add_dll_directory(sys.prefix)
