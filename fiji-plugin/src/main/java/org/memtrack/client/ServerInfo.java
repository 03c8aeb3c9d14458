// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import java.util.List;
import java.util.Map;

/**
 * What a server says of itself.
 *
 * @param protocol version of the contract it speaks
 * @param version version of its package
 * @param pythonVersion version of its Python
 * @param libraries versions of the libraries in use, by name
 * @param devices devices that passed a one-operation test; empty unless the test was asked for
 * @param maxFilmBytes largest film accepted, in bytes of samples
 * @param spoolFreeBytes free space where films are spooled, in bytes
 */
public record ServerInfo(
        int protocol,
        String version,
        String pythonVersion,
        Map<String, String> libraries,
        List<String> devices,
        long maxFilmBytes,
        long spoolFreeBytes) {}
