// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import io.grpc.ManagedChannel;
import io.grpc.stub.ClientCallStreamObserver;
import java.time.Duration;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.DetectorException;
import org.memtrack.v1.DetectFilmRequest;
import org.memtrack.v1.DetectionServiceGrpc;
import org.memtrack.video.Film;

/** One call of DetectFilm: sends chunks whenever the connection takes them, and hears the answers in between. */
final class DetectionCall {
    /** How often cancelling and silence are looked for while nothing else happens. */
    private static final long POLL_MILLISECONDS = 100;

    private final ManagedChannel channel;
    private final Film film;
    private final FilmUpload upload;
    private final Progress progress;
    private final Duration idleLimit;
    private final Answers answers;

    DetectionCall(
            ManagedChannel channel, Film film, DetectionSettings settings, Progress progress, Duration idleLimit) {
        this.channel = channel;
        this.film = film;
        this.upload = new FilmUpload(film, settings);
        this.progress = progress;
        this.idleLimit = idleLimit;
        this.answers = new Answers(film.info().frameCount());
    }

    DetectionResult run() {
        ClientCallStreamObserver<DetectFilmRequest> call = (ClientCallStreamObserver<DetectFilmRequest>)
                DetectionServiceGrpc.newStub(channel).detectFilm(answers);
        try {
            return exchange(call);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new CancellationException("Interrupted.");
        } finally {
            // Without effect on a call that has ended.
            call.cancel("no longer wanted", null);
        }
    }

    private DetectionResult exchange(ClientCallStreamObserver<DetectFilmRequest> call) throws InterruptedException {
        long seen = 0;
        long lastEvent = System.nanoTime();
        while (true) {
            progress.throwIfCancelled();
            DetectionResult result = answers.result();
            if (result != null) {
                return result;
            }
            report(answers.takeStanding());
            if (upload.hasNext() && call.isReady()) {
                call.onNext(upload.next());
                if (!upload.hasNext()) {
                    call.onCompleted();
                }
                lastEvent = System.nanoTime();
                continue;
            }
            long now = answers.await(seen, POLL_MILLISECONDS);
            if (now != seen) {
                seen = now;
                lastEvent = System.nanoTime();
            } else if (System.nanoTime() - lastEvent > idleLimit.toNanos()) {
                throw new DetectorException(("The server has been silent for %d s: it may be overloaded or out of"
                                + " memory; try a shorter film, or restart ImageJ to start a new server.")
                        .formatted(idleLimit.toSeconds()));
            }
        }
    }

    private void report(org.memtrack.v1.@Nullable Progress standing) {
        if (standing == null) {
            return;
        }
        OptionalDouble secondsLeft = standing.hasSecondsLeft()
                ? OptionalDouble.of(Math.max(0, standing.getSecondsLeft()))
                : OptionalDouble.empty();
        double fraction = Math.min(1, Math.max(0, standing.getFraction()));
        progress.report(
                Messages.stage(standing.getStage()),
                fraction,
                secondsLeft,
                standing.getFilmsAhead() > 0
                        ? "waiting for %d other films".formatted(standing.getFilmsAhead())
                        : "frame %d of %d"
                                .formatted(standing.getFramesDone(), film.info().frameCount()));
    }
}
