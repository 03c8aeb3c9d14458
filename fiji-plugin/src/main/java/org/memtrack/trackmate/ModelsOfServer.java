// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import java.util.List;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.concurrent.ExecutionException;
import java.util.function.Consumer;
import javax.swing.SwingWorker;
import org.memtrack.client.ModelCard;
import org.memtrack.client.Progress;
import org.memtrack.server.ServerConnection;
import org.memtrack.server.ServerSettings;
import org.memtrack.server.Servers;

/** Asks the server for its models, off the event thread, starting it if need be. */
final class ModelsOfServer extends SwingWorker<List<ModelCard>, String> {
    private final Consumer<String> state;
    private final Consumer<List<ModelCard>> models;

    /**
     * A question, to be asked by {@link #execute}.
     *
     * @param state told on the event thread how the server is
     * @param models given them on the event thread, when there are any
     */
    ModelsOfServer(Consumer<String> state, Consumer<List<ModelCard>> models) {
        this.state = state;
        this.models = models;
    }

    @Override
    protected List<ModelCard> doInBackground() {
        try (ServerConnection connection = Servers.acquire(ServerSettings.DEFAULTS, new Startup())) {
            publish("Ready: memtrack %s, %s.".formatted(connection.info().version(), connection.origin()));
            return connection.client().models();
        }
    }

    private final class Startup implements Progress {
        @Override
        public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {
            publish(message.isEmpty() ? stage + " …" : "%s: %s".formatted(stage, message));
        }

        @Override
        public boolean cancelled() {
            return isCancelled();
        }
    }

    @Override
    protected void process(List<String> states) {
        if (!isDone()) {
            state.accept(states.get(states.size() - 1));
        }
    }

    @Override
    protected void done() {
        try {
            List<ModelCard> cards = get();
            state.accept("Ready, %d %s.".formatted(cards.size(), cards.size() == 1 ? "model" : "models"));
            models.accept(cards);
        } catch (CancellationException e) {
            // The panel is gone.
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (ExecutionException e) {
            state.accept(String.valueOf(e.getCause().getMessage()));
        }
    }
}
