# SPDX-License-Identifier: GPL-3.0-or-later
"""Readers and writers of tracks: one call for every format, told apart by the file's ending and first words.

| ending | what | read | written |
|---|---|---|---|
| .csv, .tsv | ours, the authors' `Raw Data.csv`, truth tables `frame,id,x,y,...` | yes | ours |
| .mdf | MTrackJ | yes | yes |
| .xml | TrackMate's model file, and its "Export tracks to XML" | yes | model file |
| .txt | MOT challenge and SORT: `frame,id,left,top,width,height,score,...`, frames from 1 | yes | no |
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from memtrack.errors import InvalidInputError
from memtrack.film import Calibration
from memtrack.formats import csv_tracks, mtrackj, trackmate_writer, trackmate_xml
from memtrack.tracks import UNCALIBRATED, TrackTable


def read_tracks(path: Path, calibration: Calibration = UNCALIBRATED, *, linked_only: bool = True) -> TrackTable:
    """Read the tracks of a file, in pixels and frames from 0.

    Args:
        path: the file; its ending says the format.
        calibration: of the film. Needed for positions in micrometres when the file itself has no pixel size; what
            it gives takes the place of what the file says.
        linked_only: leave out detections that belong to no track (a TrackMate spot without a track, a row with
            the track id -1); they are given the id UNLINKED otherwise.

    Raises:
        InvalidInputError: the file cannot be read, is of another format, or one of its rows is impossible.
    """
    readers = {
        ".csv": csv_tracks.read,
        ".tsv": csv_tracks.read,
        ".txt": csv_tracks.read_mot,
        ".mdf": mtrackj.read,
        ".xml": trackmate_xml.read,
    }
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise InvalidInputError(f"{path} does not end in one of {', '.join(readers)}; convert it or rename it")
    try:
        table = reader(path, calibration)
    except ValueError as error:
        raise InvalidInputError(f"{path}: {error}; correct the file") from error
    known = replace(
        table.calibration,
        **{name: value for name in _CALIBRATION if (value := getattr(calibration, name)) is not None},
    )
    table = replace(table, calibration=known)
    return table.select(table.ids >= 0) if linked_only else table


def write_tracks(path: Path, table: TrackTable, *, film: trackmate_writer.FilmFile | None = None) -> None:
    """Write tracks as CSV (.csv), MTrackJ (.mdf) or TrackMate (.xml), whole or not at all.

    `film` lets TrackMate open the tracks on their film. MDF has no room for boxes and scores.

    Raises:
        InvalidInputError: another ending, or the file cannot be written.
    """
    match path.suffix.lower():
        case ".csv":
            csv_tracks.write(path, table)
        case ".mdf":
            mtrackj.write(path, table)
        case ".xml":
            trackmate_writer.write(path, table, film)
        case other:
            raise InvalidInputError(f"cannot write tracks as {other!r} ({path}); use .csv, .mdf or .xml")


_CALIBRATION = ("pixel_size_um", "frame_interval_seconds")
