# SPDX-License-Identifier: GPL-3.0-or-later
"""The service that tells what this server is: versions, limits, devices and models."""

from __future__ import annotations

import logging
import platform

import grpc

from memtrack import __version__, messages
from memtrack.config import PROTOCOL, Limits
from memtrack.errors import MemtrackError
from memtrack.libraries import library_versions, working_devices
from memtrack.models import list_models, load_model
from memtrack.spool import SpoolFolder
from memtrack.v1 import server_pb2 as pb
from memtrack.v1 import server_pb2_grpc

_log = logging.getLogger(__name__)


class ServerService(server_pb2_grpc.ServerServiceServicer):
    """See the contract."""

    def __init__(self, spool: SpoolFolder, limits: Limits) -> None:
        self._spool = spool
        self._limits = limits

    def GetServerInfo(
        self, request: pb.GetServerInfoRequest, context: grpc.ServicerContext
    ) -> pb.GetServerInfoResponse:
        """Versions, limits and, when asked for, devices."""
        return pb.GetServerInfoResponse(
            protocol=PROTOCOL,
            version=__version__,
            python_version=platform.python_version(),
            libraries=library_versions(),
            devices=working_devices() if request.test_devices else [],
            max_film_bytes=self._limits.max_film_bytes,
            spool_free_bytes=self._spool.free_bytes(),
        )

    def ListModels(self, request: pb.ListModelsRequest, context: grpc.ServicerContext) -> pb.ListModelsResponse:
        """The registry's models; those whose files are damaged are left out, since they cannot be used."""
        models = []
        for card in list_models():
            try:
                models.append(messages.card(card, load_model(card.name, card.version).digest))
            except (MemtrackError, OSError) as error:
                _log.warning("a model is left out: %s", error)
        return pb.ListModelsResponse(models=models)
