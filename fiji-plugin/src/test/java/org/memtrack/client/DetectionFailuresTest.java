// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.memtrack.client.ScriptedServer.accepted;
import static org.memtrack.client.ScriptedServer.frame;
import static org.memtrack.client.ScriptedServer.summary;

import io.grpc.Status;
import io.grpc.stub.StreamObserver;
import java.time.Duration;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.detection.DetectorException;
import org.memtrack.v1.DetectFilmResponse;
import org.memtrack.v1.Detection;
import org.memtrack.v1.FrameDetections;
import org.memtrack.video.Film;
import org.memtrack.video.FilmInfo;
import org.memtrack.video.SampleType;

@Timeout(600)
class DetectionFailuresTest {
    private static final SyntheticFilm FILM = new SyntheticFilm(7, 5, 4, SampleType.UINT8);

    /** At once, but on a machine with much else to do; a third of the silence after which a server is given up. */
    private static final long SOON_SECONDS = 10;

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    INVALID_ARGUMENT    | frame 3 holds NaN; set it to 0 | Frame 3 holds NaN; set it to 0.
                    NOT_FOUND           | no model "x"; choose another   | No model "x"; choose another.
                    RESOURCE_EXHAUSTED  | the disk is full; make room.   | The disk is full; make room.
                    FAILED_PRECONDITION | model "x" is damaged           | Model "x" is damaged.
                    UNAUTHENTICATED     | -                              | MEMTRACK_TOKEN
                    UNAVAILABLE         | io exception                   | run again
                    DEADLINE_EXCEEDED   | no frame came for 60 s         | No frame came for 60 s.
                    DEADLINE_EXCEEDED   | ''                             | did not answer in time
                    UNIMPLEMENTED       | -                              | no MEMTrack server
                    INTERNAL            | ZeroDivisionError              | ZeroDivisionError
                    """)
    void everyStatusBecomesOneSentence(Status.Code code, String said, String expected) throws Exception {
        Status status = code.toStatus().withDescription(said);
        assertThatThrownBy(() -> detect(responses -> responses.onError(status.asRuntimeException())))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining(expected)
                .message()
                .endsWith(".")
                .doesNotContain("\n");
    }

    @Test
    void theDeadlineOfAnotherCallIsOursAndNotTheServers() {
        Status ours = Status.DEADLINE_EXCEEDED.withDescription("CallOptions deadline exceeded after 29.9s");
        assertThat(Failures.of(ours))
                .hasMessage("The server did not answer in time: the computer may be too busy; run again, or restart"
                        + " ImageJ to start a new server.");
    }

    @Test
    void aFrameOutOfOrderIsRefused() {
        assertThatThrownBy(() -> detect(responses -> {
                    responses.onNext(accepted());
                    responses.onNext(frame(1));
                }))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("frame 1 of 4 came where frame 0 was due");
    }

    @Test
    void anEndAfterTooFewFramesIsRefused() {
        assertThatThrownBy(() -> detect(responses -> {
                    responses.onNext(accepted());
                    responses.onNext(frame(0));
                    responses.onNext(summary(4));
                    responses.onCompleted();
                }))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("after 1 of 4 frames");
    }

    @Test
    void anEndWithoutASummaryIsRefused() {
        assertThatThrownBy(() -> detect(responses -> {
                    responses.onNext(accepted());
                    for (int i = 0; i < 4; i++) {
                        responses.onNext(frame(i));
                    }
                    responses.onCompleted();
                }))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("without a summary");
    }

    @Test
    void aBoxThatIsNoBoxIsRefused() {
        FrameDetections broken = FrameDetections.newBuilder()
                .addDetections(Detection.newBuilder().setXMin(Float.NaN))
                .build();
        assertThatThrownBy(() -> detect(responses -> {
                    responses.onNext(accepted());
                    responses.onNext(
                            DetectFilmResponse.newBuilder().setFrame(broken).build());
                }))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("NaN");
    }

    @Test
    void anEmptyMessageIsRefused() {
        assertThatThrownBy(() -> detect(responses -> responses.onNext(DetectFilmResponse.getDefaultInstance())))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("an empty message");
    }

    @Test
    void aSilentServerIsGivenUp() throws Exception {
        try (ScriptedServer server = new ScriptedServer(responses -> {})) {
            DetectionClient client = server.client(Duration.ofMillis(300));
            assertThatThrownBy(() -> client.detect(FILM, DetectionSettings.DEFAULTS, Progress.NONE))
                    .isInstanceOf(DetectorException.class)
                    .hasMessageContaining("silent");
            assertThat(server.cancelled.await(SOON_SECONDS, TimeUnit.SECONDS)).isTrue();
        }
    }

    @Test
    void cancellingEndsTheCallOnBothSidesWithinASecond() throws Exception {
        CountDownLatch received = new CountDownLatch(1);
        try (ScriptedServer server = new ScriptedServer(responses -> received.countDown())) {
            DetectionClient client = server.client();
            CompletableFuture<DetectionResult> result = CompletableFuture.supplyAsync(
                    () -> client.detect(FILM, DetectionSettings.DEFAULTS, cancelledOnce(received)));
            received.await();
            long start = System.nanoTime();
            assertThatThrownBy(() -> result.get(1, TimeUnit.SECONDS)).hasCauseInstanceOf(CancellationException.class);
            assertThat(server.cancelled.await(1, TimeUnit.SECONDS)).isTrue();
            assertThat(System.nanoTime() - start).isLessThan(TimeUnit.SECONDS.toNanos(1));
        }
    }

    @Test
    void anInterruptEndsTheCallAndStaysVisible() throws Exception {
        try (ScriptedServer server = new ScriptedServer(responses -> Thread.yield())) {
            DetectionClient client = server.client();
            CompletableFuture<Boolean> flag = new CompletableFuture<>();
            Thread caller = new Thread(() -> {
                try {
                    client.detect(FILM, DetectionSettings.DEFAULTS, Progress.NONE);
                } catch (CancellationException e) {
                    flag.complete(Thread.currentThread().isInterrupted());
                }
            });
            caller.start();
            server.headerReceived.await();
            caller.interrupt();
            assertThat(flag.get(SOON_SECONDS, TimeUnit.SECONDS)).isTrue();
        }
    }

    @Test
    void aServerThatDiesMidwayIsReportedAtOnce() throws Exception {
        CountDownLatch received = new CountDownLatch(1);
        try (ScriptedServer server = new ScriptedServer(responses -> received.countDown())) {
            DetectionClient client = server.client();
            CompletableFuture<DetectionResult> result =
                    CompletableFuture.supplyAsync(() -> client.detect(FILM, DetectionSettings.DEFAULTS, Progress.NONE));
            received.await();
            server.kill();
            assertThatThrownBy(() -> result.get(SOON_SECONDS, TimeUnit.SECONDS))
                    .isInstanceOf(ExecutionException.class)
                    .hasRootCauseInstanceOf(io.grpc.StatusRuntimeException.class)
                    .cause()
                    .isInstanceOf(DetectorException.class)
                    .hasMessageContaining("run again");
        }
    }

    @Test
    void framesAreNotReadAheadOfAServerThatDoesNotTakeThem() throws Exception {
        SyntheticFilm film = new SyntheticFilm(700, 700, 1000, SampleType.UINT8);
        try (ScriptedServer server = new ScriptedServer(responses -> {}, false)) {
            DetectionClient client = server.client(Duration.ofMillis(500));
            assertThatThrownBy(() -> client.detect(film, DetectionSettings.DEFAULTS, Progress.NONE))
                    .isInstanceOf(DetectorException.class);
            assertThat(film.framesRead.get()).isLessThan(5);
        }
    }

    @Test
    void aFilmThatCannotBeReadEndsTheCall() throws Exception {
        Film broken = new Film() {
            @Override
            public FilmInfo info() {
                return FILM.info();
            }

            @Override
            public SampleType sampleType() {
                return SampleType.UINT8;
            }

            @Override
            public byte[] frame(int frame) {
                throw new DetectorException("Slice 1 cannot be read: open the film again.");
            }
        };
        try (ScriptedServer server = new ScriptedServer(responses -> {})) {
            DetectionClient client = server.client();
            assertThatThrownBy(() -> client.detect(broken, DetectionSettings.DEFAULTS, Progress.NONE))
                    .hasMessage("Slice 1 cannot be read: open the film again.");
            assertThat(server.cancelled.await(SOON_SECONDS, TimeUnit.SECONDS)).isTrue();
        }
    }

    private static void detect(Consumer<StreamObserver<DetectFilmResponse>> script) throws Exception {
        try (ScriptedServer server = new ScriptedServer(script)) {
            server.client().detect(FILM, DetectionSettings.DEFAULTS, Progress.NONE);
        }
    }

    private static Progress cancelledOnce(CountDownLatch reached) {
        return new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {}

            @Override
            public boolean cancelled() {
                return reached.getCount() == 0;
            }
        };
    }
}
