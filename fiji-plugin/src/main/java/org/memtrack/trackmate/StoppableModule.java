// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Logger;
import org.jspecify.annotations.Nullable;
import org.scijava.Cancelable;

/** What the detector and the tracker owe TrackMate alike: a logger, one sentence of what is wrong, and a stop button. */
abstract class StoppableModule implements Cancelable {
    Logger logger = Logger.VOID_LOGGER;

    private String errorMessage = "";
    private volatile boolean canceled;
    private volatile @Nullable String cancelReason;

    /** Keeps the sentence that says what is wrong, if there is one; whether there is none. */
    final boolean isFine(@Nullable String problem) {
        errorMessage = problem == null ? "" : problem;
        return problem == null;
    }

    public String getErrorMessage() {
        return errorMessage;
    }

    public void setLogger(Logger newLogger) {
        this.logger = newLogger;
    }

    @Override
    public boolean isCanceled() {
        return canceled;
    }

    @Override
    public void cancel(@Nullable String reason) {
        cancelReason = reason;
        canceled = true;
    }

    @Override
    public @Nullable String getCancelReason() {
        return cancelReason;
    }
}
