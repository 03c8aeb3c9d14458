# SPDX-License-Identifier: GPL-3.0-or-later
"""Films from files, for the command line: TIFF with ImageJ's and OME's tags, video files, folders of images.

Every reader gives grey frames of uint8, uint16 or float32 and says in `notes` what it changed or assumed. Paths may
hold any character: images are decoded from bytes, since OpenCV mistreats such file names on Windows.
"""

from memtrack.video.opening import OpenedFilm, open_film

__all__ = ["OpenedFilm", "open_film"]
