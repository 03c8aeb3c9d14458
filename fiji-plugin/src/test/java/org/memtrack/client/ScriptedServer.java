// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import com.google.protobuf.ByteString;
import io.grpc.ManagedChannel;
import io.grpc.Server;
import io.grpc.inprocess.InProcessChannelBuilder;
import io.grpc.inprocess.InProcessServerBuilder;
import io.grpc.stub.ServerCallStreamObserver;
import io.grpc.stub.StreamObserver;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import org.memtrack.v1.Accepted;
import org.memtrack.v1.DetectFilmRequest;
import org.memtrack.v1.DetectFilmResponse;
import org.memtrack.v1.Detection;
import org.memtrack.v1.DetectionServiceGrpc;
import org.memtrack.v1.FilmHeader;
import org.memtrack.v1.FrameDetections;
import org.memtrack.v1.Level;
import org.memtrack.v1.LevelThresholds;
import org.memtrack.v1.Progress;
import org.memtrack.v1.Stage;
import org.memtrack.v1.Summary;

/** A server in the same process that receives a film, then answers as its script says. */
final class ScriptedServer extends DetectionServiceGrpc.DetectionServiceImplBase implements AutoCloseable {
    final List<FilmHeader> headers = new ArrayList<>();
    final List<Integer> chunkFrames = new ArrayList<>();
    final List<Integer> chunkSizes = new ArrayList<>();
    final ByteArrayOutputStream received = new ByteArrayOutputStream();
    final CountDownLatch cancelled = new CountDownLatch(1);
    final CountDownLatch headerReceived = new CountDownLatch(1);

    private final Consumer<StreamObserver<DetectFilmResponse>> script;
    private final boolean taking;
    private final Server server;
    private final ManagedChannel channel;

    /**
     * @param script called with the client's observer when the film is complete
     * @param taking whether frames are taken; otherwise nothing after the header is asked for
     */
    ScriptedServer(Consumer<StreamObserver<DetectFilmResponse>> script, boolean taking) throws IOException {
        this.script = script;
        this.taking = taking;
        String name = InProcessServerBuilder.generateName();
        server = InProcessServerBuilder.forName(name).addService(this).build().start();
        channel = InProcessChannelBuilder.forName(name).build();
    }

    ScriptedServer(Consumer<StreamObserver<DetectFilmResponse>> script) throws IOException {
        this(script, true);
    }

    DetectionClient client(Duration idleLimit) {
        return new DetectionClient(channel, idleLimit);
    }

    DetectionClient client() {
        return client(Duration.ofSeconds(30));
    }

    /** Ends at once, under the calls at work. */
    void kill() {
        server.shutdownNow();
    }

    @Override
    public StreamObserver<DetectFilmRequest> detectFilm(StreamObserver<DetectFilmResponse> responses) {
        ServerCallStreamObserver<DetectFilmResponse> call = (ServerCallStreamObserver<DetectFilmResponse>) responses;
        call.setOnCancelHandler(cancelled::countDown);
        if (!taking) {
            call.disableAutoRequest();
            call.request(1);
        }
        return new StreamObserver<>() {
            @Override
            public void onNext(DetectFilmRequest request) {
                if (request.hasHeader()) {
                    headers.add(request.getHeader());
                    headerReceived.countDown();
                } else {
                    ByteString data = request.getChunk().getData();
                    chunkFrames.add(request.getChunk().getFrame());
                    chunkSizes.add(data.size());
                    received.writeBytes(data.toByteArray());
                }
            }

            @Override
            public void onError(Throwable error) {
                cancelled.countDown();
            }

            @Override
            public void onCompleted() {
                script.accept(responses);
            }
        };
    }

    @Override
    public void close() throws InterruptedException {
        channel.shutdownNow().awaitTermination(5, TimeUnit.SECONDS);
        server.shutdownNow().awaitTermination(5, TimeUnit.SECONDS);
    }

    static DetectFilmResponse accepted() {
        return DetectFilmResponse.newBuilder()
                .setAccepted(Accepted.newBuilder()
                        .setModelName("collagen")
                        .setModelVersion("1.2.3")
                        .setModelSha256("abc")
                        .setThresholds(LevelThresholds.newBuilder()
                                .setLow(0.5)
                                .setMedium(0.6)
                                .setHigh(0.7))
                        .setScale(1.5)
                        .setEngine("some engine")
                        .addWarnings("A warning."))
                .build();
    }

    static DetectFilmResponse progress(double fraction) {
        return DetectFilmResponse.newBuilder()
                .setProgress(Progress.newBuilder()
                        .setStage(Stage.STAGE_DETECTING)
                        .setFramesDone(3)
                        .setFramesTotal(4)
                        .setFraction(fraction)
                        .setSecondsLeft(12.5))
                .build();
    }

    /** Detections of a frame: as many as its number, each at its own place. */
    static DetectFilmResponse frame(int frame) {
        FrameDetections.Builder found =
                FrameDetections.newBuilder().setFrame(frame).setDriftX(0.25).setDriftY(-0.5);
        for (int i = 0; i < frame; i++) {
            found.addDetections(Detection.newBuilder()
                    .setXMin(i)
                    .setYMin(10 + i)
                    .setXMax(i + 20)
                    .setYMax(i + 40)
                    .setScore(0.75f)
                    .setLevel(Level.LEVEL_MEDIUM)
                    .setContrast(-0.5f)
                    .setError(0.25f));
        }
        found.addFaint(Detection.newBuilder()
                .setXMin(50)
                .setYMin(60)
                .setXMax(80)
                .setYMax(90)
                .setScore(0.125f)
                .setLevel(Level.LEVEL_LOW));
        return DetectFilmResponse.newBuilder().setFrame(found).build();
    }

    static DetectFilmResponse summary(int frameCount) {
        return DetectFilmResponse.newBuilder()
                .setSummary(Summary.newBuilder()
                        .setFrameCount(frameCount)
                        .setCandidates(100)
                        .setTooLarge(1)
                        .setNearMisses(20)
                        .setOverlapping(3)
                        .setOutsideRegion(4)
                        .setKept(72)
                        .setCandidateFloor(0.2)
                        .setFilmSha256("def")
                        .addWarnings("2 of 3 frames are dark."))
                .build();
    }
}
