# SPDX-License-Identifier: GPL-3.0-or-later
"""The contract of proto/memtrack/v1 in Python; the modules `*_pb2` and `*_pb2_grpc` are generated at build time."""
