// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;

/** Where long work reports to, and learns that the user no longer wants it; called from the thread that does the work. */
public interface Progress {
    /** Hears nothing and never cancels. */
    Progress NONE = new Progress() {
        @Override
        public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {}

        @Override
        public boolean cancelled() {
            return false;
        }
    };

    /**
     * Tells where the work stands.
     *
     * @param stage step at work, for the user, for example "Detecting"
     * @param fraction share of the whole work that is done, in [0, 1]
     * @param secondsLeft estimated time to the end, in seconds; empty until it can be told
     * @param message what is done just now, for the user, for example "frame 12 of 60"
     */
    void report(String stage, double fraction, OptionalDouble secondsLeft, String message);

    /** Whether the user has cancelled; asked several times a second. */
    boolean cancelled();

    /** @throws CancellationException when the user has cancelled */
    default void throwIfCancelled() {
        if (cancelled()) {
            throw new CancellationException("Cancelled by the user.");
        }
    }

    /** The part of this progress between two fractions, for work that is a step of greater work. */
    default Progress between(double start, double end) {
        Progress whole = this;
        return new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {
                whole.report(stage, start + fraction * (end - start), secondsLeft, message);
            }

            @Override
            public boolean cancelled() {
                return whole.cancelled();
            }
        };
    }
}
