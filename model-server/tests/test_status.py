# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import logging

import grpc
import pytest

from memtrack import errors
from memtrack.status import STATUS, status_of

CODES = grpc.StatusCode
OUTCOMES = {
    errors.InvalidInputError: CODES.INVALID_ARGUMENT,
    errors.FilmError: CODES.INVALID_ARGUMENT,
    errors.SettingsError: CODES.INVALID_ARGUMENT,
    errors.ModelNotFoundError: CODES.NOT_FOUND,
    errors.ModelCorruptError: CODES.FAILED_PRECONDITION,
    errors.EngineUnavailableError: CODES.FAILED_PRECONDITION,
    errors.ResourceLimitError: CODES.RESOURCE_EXHAUSTED,
    errors.IdleError: CODES.DEADLINE_EXCEEDED,
    errors.ShutdownError: CODES.UNAVAILABLE,
    errors.CancelledError: CODES.CANCELLED,
}


def tree(root: type[BaseException]) -> set[type[BaseException]]:
    return {root}.union(*(tree(child) for child in root.__subclasses__()))


def test_every_error_for_the_user_has_an_outcome_of_the_closed_list() -> None:
    assert tree(errors.MemtrackError) - {errors.MemtrackError} == set(OUTCOMES)
    for kind, code in OUTCOMES.items():
        assert status_of(kind("the sentence")) == (code, "the sentence")
    assert set(STATUS) <= set(OUTCOMES)


@pytest.mark.parametrize("error", [ValueError("x"), KeyError("x"), OSError(5, "x")])
def test_what_is_not_for_the_user_is_internal_and_logged(error: Exception, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.ERROR):
        code, sentence = status_of(error)
    assert code is CODES.INTERNAL
    assert type(error).__name__ in sentence
    assert caplog.records[0].exc_info is not None


def test_running_out_of_memory_is_told_as_a_limit() -> None:
    code, sentence = status_of(MemoryError())
    assert code is CODES.RESOURCE_EXHAUSTED
    assert "out of memory" in sentence
