// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;

/** Finds in what pip printed the cause that a user can do something about. */
final class InstallFailures {
    private static final Map<Pattern, String> KNOWN = new LinkedHashMap<>();

    static {
        known("No space left on device|not enough space on the disk", "the disk is full");
        known(
                "CERTIFICATE_VERIFY_FAILED|SSLError",
                "the package index's certificate was not accepted; a proxy may stand between");
        known("ProxyError|407 Proxy", "the proxy refused the connection; check HTTPS_PROXY");
        known(
                "NewConnectionError|NameResolutionError|Temporary failure in name resolution|getaddrinfo failed|ConnectTimeout"
                        + "|ReadTimeoutError|Network is unreachable|Connection refused",
                "the package index cannot be reached; check the network");
        known(
                "filename or extension is too long|WinError 206",
                "the path is too long for Windows; set MEMTRACK_HOME to a short one");
        // Windows says the rest in the user's language: access denied, used by another program, taken for a virus.
        known(
                "WinError (5|32|225)\\b|Permission denied",
                "a file in the folder could not be written; if a virus scanner holds it, allow it the folder, and try again");
        known(
                "GLIBC_[0-9.]+' not found",
                "the Python of the jar needs a newer Linux; install Python 3.11 or newer from the system's packages");
        known("ensurepip is not available", "it lacks venv; install the package python3-venv");
    }

    private InstallFailures() {}

    /** The cause as a clause; the last error that pip named when the cause is none of the usual ones. */
    static String cause(List<String> lines) {
        for (Map.Entry<Pattern, String> known : KNOWN.entrySet()) {
            if (lines.stream().anyMatch(line -> known.getKey().matcher(line).find())) {
                return known.getValue();
            }
        }
        String last = "";
        for (String line : lines) {
            if (line.startsWith("ERROR:") || last.isEmpty() && !line.isBlank()) {
                last = line.replaceFirst("^ERROR: *", "").strip();
            }
        }
        return last.isEmpty() ? "it did not say why" : last;
    }

    private static void known(String pattern, String cause) {
        KNOWN.put(Pattern.compile(pattern), cause);
    }
}
