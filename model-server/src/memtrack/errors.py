# SPDX-License-Identifier: GPL-3.0-or-later
"""The errors a user can meet; each message is one sentence: what, with which value, what to do next.

MemtrackError
├── InvalidInputError        the film, a setting or a file is not usable as given
│   ├── FilmError            a film cannot be read or has an impossible shape
│   └── SettingsError        a setting is unknown, of the wrong type or out of range
├── ModelNotFoundError       no model of that name and version in the registry
├── ModelCorruptError        a model's files do not match its card
├── EngineUnavailableError   the computing library a model needs is not installed
├── ResourceLimitError       the film would not fit the limits on size, memory or disk
├── IdleError                the client went silent in the middle of a film
├── ShutdownError            the server ends while a film is at work
└── CancelledError           the caller no longer wants the result

`memtrack.status` maps each class to one gRPC status; the command line prints the message and ends with code 2.
"""


class MemtrackError(Exception):
    """Base of every error that is meant for the user."""


class InvalidInputError(MemtrackError):
    """The film, a setting or a file is not usable as given."""


class FilmError(InvalidInputError):
    """A film cannot be read or has an impossible shape."""


class SettingsError(InvalidInputError):
    """A setting is unknown, of the wrong type or out of range."""


class ModelNotFoundError(MemtrackError):
    """No model of that name and version is in the registry."""


class ModelCorruptError(MemtrackError):
    """A model's files do not match its card."""


class EngineUnavailableError(MemtrackError):
    """The computing library a model needs is not installed."""


class ResourceLimitError(MemtrackError):
    """The film would not fit the limits on size, memory or disk."""


class IdleError(MemtrackError):
    """The client went silent in the middle of a film."""


class ShutdownError(MemtrackError):
    """The server ends while a film is at work."""


class CancelledError(MemtrackError):
    """The caller no longer wants the result."""
