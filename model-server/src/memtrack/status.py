# SPDX-License-Identifier: GPL-3.0-or-later
"""How a call can end: the one table from errors to gRPC status codes."""

from __future__ import annotations

import logging

import grpc

from memtrack import errors

STATUS: dict[type[errors.MemtrackError], grpc.StatusCode] = {
    errors.InvalidInputError: grpc.StatusCode.INVALID_ARGUMENT,
    errors.ModelNotFoundError: grpc.StatusCode.NOT_FOUND,
    errors.ModelCorruptError: grpc.StatusCode.FAILED_PRECONDITION,
    errors.EngineUnavailableError: grpc.StatusCode.FAILED_PRECONDITION,
    errors.ResourceLimitError: grpc.StatusCode.RESOURCE_EXHAUSTED,
    errors.IdleError: grpc.StatusCode.DEADLINE_EXCEEDED,
    errors.ShutdownError: grpc.StatusCode.UNAVAILABLE,
    errors.CancelledError: grpc.StatusCode.CANCELLED,
}

_log = logging.getLogger(__name__)


def status_of(error: BaseException) -> tuple[grpc.StatusCode, str]:
    """The status and the sentence for the user that stand for `error`; what is not for the user goes to the log."""
    for kind in type(error).__mro__:
        if kind in STATUS:
            return STATUS[kind], str(error)
    if isinstance(error, MemoryError):
        return grpc.StatusCode.RESOURCE_EXHAUSTED, "the server ran out of memory; close other programs or crop the film"
    _log.error("unexpected failure", exc_info=error)
    return (
        grpc.StatusCode.INTERNAL,
        f"the server failed unexpectedly ({type(error).__name__}: {error}); its log has the details, please report it",
    )
