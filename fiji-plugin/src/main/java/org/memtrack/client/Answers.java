// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import io.grpc.Status;
import io.grpc.stub.ClientCallStreamObserver;
import io.grpc.stub.ClientResponseObserver;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.DetectorException;
import org.memtrack.detection.FrameDetections;
import org.memtrack.v1.DetectFilmRequest;
import org.memtrack.v1.DetectFilmResponse;
import org.memtrack.v1.Progress;

/** What the server has answered so far in one call: filled by grpc's threads, awaited by the caller's. */
final class Answers implements ClientResponseObserver<DetectFilmRequest, DetectFilmResponse> {
    private final int frameCount;
    private final List<FrameDetections> frames = new ArrayList<>();
    private @Nullable ClientCallStreamObserver<DetectFilmRequest> call;
    private @Nullable ModelInUse accepted;
    private @Nullable DetectionSummary summary;
    private @Nullable Progress standing;
    private @Nullable RuntimeException failure;
    private boolean closed;
    private long events;

    Answers(int frameCount) {
        this.frameCount = frameCount;
    }

    @Override
    public void beforeStart(ClientCallStreamObserver<DetectFilmRequest> started) {
        call = started;
        started.setOnReadyHandler(this::wake);
    }

    @Override
    public synchronized void onNext(DetectFilmResponse response) {
        wake();
        try {
            switch (response.getMessageCase()) {
                case ACCEPTED -> accepted = Messages.model(response.getAccepted());
                case PROGRESS -> standing = response.getProgress();
                case FRAME -> addFrame(Messages.frame(response.getFrame()));
                case SUMMARY -> summary = Messages.summary(response.getSummary());
                case MESSAGE_NOT_SET -> throw new IllegalArgumentException("an empty message");
            }
        } catch (IllegalArgumentException e) {
            fail(new DetectorException(
                    "The server's answer breaks the contract (%s): update both sides to the same version."
                            .formatted(e.getMessage()),
                    e));
        }
    }

    @Override
    public synchronized void onError(Throwable error) {
        wake();
        closed = true;
        if (failure == null) {
            failure = Failures.ofFilm(Status.fromThrowable(error));
        }
    }

    @Override
    public synchronized void onCompleted() {
        wake();
        closed = true;
        if (failure == null && (accepted == null || summary == null || frames.size() != frameCount)) {
            failure = new DetectorException(
                    ("The server ended after %d of %d frames%s: update both sides to the same" + " version.")
                            .formatted(frames.size(), frameCount, summary == null ? ", without a summary" : ""));
        }
    }

    /** Waits until something happened after the given count of events, or the time is over; gives the new count. */
    synchronized long await(long seen, long milliseconds) throws InterruptedException {
        long end = System.nanoTime() + TimeUnit.MILLISECONDS.toNanos(milliseconds);
        while (events == seen && !closed) {
            long left = TimeUnit.NANOSECONDS.toMillis(end - System.nanoTime());
            if (left <= 0) {
                break;
            }
            wait(left);
        }
        return events;
    }

    /** The newest standing, once. */
    synchronized @Nullable Progress takeStanding() {
        Progress taken = standing;
        standing = null;
        return taken;
    }

    /** The result when the server has closed the call, or null while it is open; throws when it failed. */
    synchronized @Nullable DetectionResult result() {
        if (failure != null) {
            throw failure;
        }
        return closed && summary != null && accepted != null ? new DetectionResult(frames, summary, accepted) : null;
    }

    private void addFrame(FrameDetections answer) {
        if (answer.frame() != frames.size() || answer.frame() >= frameCount) {
            throw new IllegalArgumentException(
                    "frame %d of %d came where frame %d was due".formatted(answer.frame(), frameCount, frames.size()));
        }
        frames.add(answer);
    }

    private void fail(RuntimeException cause) {
        if (failure == null) {
            failure = cause;
        }
        if (call != null) {
            call.cancel("broken contract", cause);
        }
    }

    private synchronized void wake() {
        events++;
        notifyAll();
    }
}
