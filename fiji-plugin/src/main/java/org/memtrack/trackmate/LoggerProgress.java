// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Logger;
import java.util.Locale;
import java.util.OptionalDouble;
import java.util.function.BooleanSupplier;
import org.memtrack.client.Progress;

/** Shows progress in TrackMate's progress bar, and each step once in its log. */
final class LoggerProgress implements Progress {
    private final Logger logger;
    private final BooleanSupplier cancelled;
    private String lastStage = "";

    LoggerProgress(Logger logger, BooleanSupplier cancelled) {
        this.logger = logger;
        this.cancelled = cancelled;
    }

    @Override
    public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {
        if (!stage.equals(lastStage)) {
            logger.log(stage + "\n");
            lastStage = stage;
        }
        logger.setProgress(fraction);
        String left = secondsLeft.isPresent()
                ? String.format(Locale.ROOT, ", about %.0f s left", secondsLeft.getAsDouble())
                : "";
        logger.setStatus(message.isEmpty() ? stage : "%s, %s%s".formatted(stage, message, left));
    }

    @Override
    public boolean cancelled() {
        return cancelled.getAsBoolean();
    }
}
