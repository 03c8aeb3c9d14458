// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import io.grpc.Status;
import java.util.Locale;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.DetectorException;

/** Turns the status of a failed call into one sentence for the user. */
final class Failures {
    private Failures() {}

    /**
     * Of a film's call, which has no deadline of its own: one that is exceeded is the server's, which waited in vain for a
     * frame and says so.
     */
    static DetectorException ofFilm(Status status) {
        String said = said(status);
        return status.getCode() == Status.Code.DEADLINE_EXCEEDED && !said.isBlank()
                ? new DetectorException(asSentence(said), status.asRuntimeException())
                : of(status);
    }

    /** Of any other call. */
    static DetectorException of(Status status) {
        String said = said(status);
        String sentence = switch (status.getCode()) {
            // The server's own sentences.
            case INVALID_ARGUMENT, NOT_FOUND, RESOURCE_EXHAUSTED, FAILED_PRECONDITION ->
                said.isBlank()
                        ? "The server refused the film (%s) and did not say why.".formatted(status.getCode())
                        : asSentence(said);
            case UNAUTHENTICATED, PERMISSION_DENIED ->
                "The server did not accept our token: for a server given"
                        + " by its address, set MEMTRACK_TOKEN to the token it was started with.";
            case UNAVAILABLE ->
                "The server cannot be reached, or was ended while it worked%s: run again, and if"
                                .formatted(innermost(status.getCause()))
                        + " that fails too, use \"MEMTrack Check Installation\".";
            case DEADLINE_EXCEEDED ->
                "The server did not answer in time: the computer may be too busy; run"
                        + " again, or restart ImageJ to start a new server.";
            case UNIMPLEMENTED ->
                "What answers at this address is no MEMTrack server, or one of another"
                        + " version: check the address, or update both sides.";
            default ->
                "The server failed (%s: %s); please report this with the output of".formatted(status.getCode(), said)
                        + " \"MEMTrack Check Installation\".";
        };
        return new DetectorException(sentence, status.asRuntimeException());
    }

    private static String said(Status status) {
        return status.getDescription() == null ? "" : status.getDescription();
    }

    /** What went wrong first, in brackets, for example that a certificate is not trusted; empty when nothing says it. */
    private static String innermost(@Nullable Throwable cause) {
        String said = "";
        for (Throwable error = cause; error != null; error = error.getCause()) {
            String message = error.getMessage();
            if (message != null && !message.isBlank()) {
                said = " (" + message.strip().lines().findFirst().orElseThrow().replaceAll("[.\\s]+$", "") + ")";
            }
        }
        return said;
    }

    private static String asSentence(String clause) {
        String stopped = clause.endsWith(".") ? clause : clause + ".";
        return stopped.substring(0, 1).toUpperCase(Locale.ROOT) + stopped.substring(1);
    }
}
