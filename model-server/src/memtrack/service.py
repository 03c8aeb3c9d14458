# SPDX-License-Identifier: GPL-3.0-or-later
"""The service behind DetectFilm: receive a film, wait for its turn, detect, and answer frame by frame."""

from __future__ import annotations

import contextlib
import dataclasses
import logging
import threading
import time
from collections.abc import Generator, Iterator
from typing import cast

import grpc

from memtrack import messages
from memtrack.calls import FilmCall
from memtrack.config import Limits
from memtrack.detections import FilterCounts, FrameDetections
from memtrack.errors import CancelledError, FilmError, ResourceLimitError, ShutdownError
from memtrack.headers import check_scaled, read_header
from memtrack.models import Model, load_model
from memtrack.pipeline import detect_film
from memtrack.progress import ProgressClock, Stage, StageCosts
from memtrack.receiving import FrameReceiver
from memtrack.scale import model_scale
from memtrack.spool import SpooledFilm, SpoolFolder
from memtrack.status import status_of
from memtrack.turns import Turns
from memtrack.v1 import detection_pb2 as pb
from memtrack.v1 import detection_pb2_grpc

_log = logging.getLogger(__name__)


class DetectionService(detection_pb2_grpc.DetectionServiceServicer):
    """Each film has a thread that receives it and works on it, and the call's own thread, which answers the client."""

    def __init__(self, spool: SpoolFolder, limits: Limits, threads: int) -> None:
        self._spool = spool
        self._limits = limits
        self._threads = threads
        self._turns = Turns()
        self._costs = StageCosts()
        self._lock = threading.Lock()
        self._calls: set[FilmCall] = set()
        self._closed = False

    def DetectFilm(
        self, request_iterator: Iterator[pb.DetectFilmRequest], context: grpc.ServicerContext
    ) -> Iterator[pb.DetectFilmResponse]:
        """See the contract."""
        call = FilmCall(self._limits.idle_seconds)
        try:
            self._open(call)
            self._start(call, request_iterator, context)
            yield from call.responses()
        except CancelledError:
            return
        except Exception as error:
            status, sentence = status_of(error)
            _log.info("film refused or given up: %s", sentence)
            context.abort(status, sentence)

    def close(self) -> None:
        """Takes no further films and ends those at work."""
        with self._lock:
            self._closed = True
            calls = list(self._calls)
        for call in calls:
            call.fail(ShutdownError("the model server is shutting down; run the film again"))

    def _open(self, call: FilmCall) -> None:
        with self._lock:
            if self._closed:
                raise ShutdownError("the model server is shutting down; run the film again")
            if len(self._calls) >= self._limits.max_films:
                raise ResourceLimitError(
                    f"the model server has {len(self._calls)} film(s) already, its limit; wait until one is done"
                )
            self._calls.add(call)

    def _start(self, call: FilmCall, requests: Iterator[pb.DetectFilmRequest], context: grpc.ServicerContext) -> None:
        """Starts the film's thread, which forgets the call at its end; without one the call is forgotten here."""
        try:
            if not context.add_callback(call.cancel):
                raise CancelledError("the film was cancelled")
            threading.Thread(target=self._work, args=(call, requests), name="film", daemon=True).start()
        except BaseException:
            self._forget(call)
            raise

    def _work(self, call: FilmCall, requests: Iterator[pb.DetectFilmRequest]) -> None:
        """The life of one film; all it holds is given back before the client hears the end."""
        try:
            summary = self._detect(call, requests)
        except grpc.RpcError:
            self._forget(call)
            call.cancel()
        except Exception as error:
            self._forget(call)
            call.fail(error)
        else:
            self._forget(call)
            call.finish(summary)

    def _forget(self, call: FilmCall) -> None:
        with self._lock:
            self._calls.discard(call)

    def _detect(self, call: FilmCall, requests: Iterator[pb.DetectFilmRequest]) -> pb.DetectFilmResponse:
        request = read_header(_header(requests), self._limits)
        model = load_model(request.settings.model, request.settings.version)
        # A missing computing library is said before the film is sent.
        model.engine(request.settings.engine)
        with self._spool.open(request.geometry, request.calibration) as film:
            check_scaled(film.geometry, model_scale(film, model, request.settings), self._limits)
            call.send(messages.accepted(request, model, film))
            progress = _Progress(call, film, self._costs)
            film_sha256 = _receive(call, requests, film, progress)
            warnings: list[str] = []
            settings = dataclasses.replace(request.settings, threads=self._threads)

            def taken(crowds: Model) -> None:
                nonlocal model
                model = crowds
                call.send(messages.accepted(request, crowds, film))

            work = detect_film(film, model, settings, progress.report, warnings.append, taken)
            frames = cast("Generator[FrameDetections]", work)
            # Closed before the spool is: the method's threads may be some frames ahead.
            with self._turns.turn(progress.wait), contextlib.closing(frames):
                progress.clock.restart()
                counts = _send_frames(call, frames)
        self._costs.learn(progress.clock.seconds, film.geometry.pixels)
        size = f"{film.frame_count} frames of {film.width} x {film.height}"
        _log.info("%s: %d detections in %.1f s", size, counts.kept, sum(progress.clock.seconds.values()))
        return messages.summary(request, model, counts, film_sha256, progress.clock.seconds, warnings)


def _header(requests: Iterator[pb.DetectFilmRequest]) -> pb.FilmHeader:
    first = next(requests, None)
    if first is None or first.WhichOneof("message") != "header":
        raise FilmError("the first message of a film must be its header")
    return first.header


def _receive(call: FilmCall, requests: Iterator[pb.DetectFilmRequest], film: SpooledFilm, progress: _Progress) -> str:
    receiver = FrameReceiver(film)
    for request in requests:
        call.check()
        call.heard()
        if request.WhichOneof("message") != "chunk":
            raise FilmError("only chunks of frames may follow the header")
        receiver.take(request.chunk)
        progress.report(Stage.RECEIVING, receiver.frames, film.frame_count)
    call.received()
    return receiver.finish()


def _send_frames(call: FilmCall, frames: Iterator[FrameDetections]) -> FilterCounts:
    counts = FilterCounts()
    for found in frames:
        call.send(messages.frame(found))
        counts += found.counts
    return counts


class _Progress:
    """Sends where the work stands a few times a second, and stops the work of a film nobody wants any more."""

    def __init__(self, call: FilmCall, film: SpooledFilm, costs: StageCosts) -> None:
        self._call = call
        self.clock = ProgressClock(film.frame_count, costs.current())
        self._said = 0.0

    def report(self, stage: Stage, done: int, total: int) -> None:
        """See `memtrack.progress.Report`."""
        self._call.check()
        standing = self.clock.advance(stage, done, total)
        now = time.monotonic()
        if done >= total or now - self._said >= 0.2:
            self._said = now
            self._call.send(messages.progress(standing))

    def wait(self, films_ahead: int) -> None:
        """Tells the client that other films come first."""
        self._call.send(messages.progress(self.clock.standing, films_ahead))
