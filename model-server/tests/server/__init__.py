# SPDX-License-Identifier: GPL-3.0-or-later
"""The model server from outside: a real process, real gRPC, the shipped model."""
