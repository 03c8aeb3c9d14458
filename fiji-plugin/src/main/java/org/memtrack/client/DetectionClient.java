// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import io.grpc.ManagedChannel;
import io.grpc.Status;
import io.grpc.StatusRuntimeException;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeUnit;
import org.memtrack.detection.DetectorException;
import org.memtrack.v1.GetServerInfoRequest;
import org.memtrack.v1.GetServerInfoResponse;
import org.memtrack.v1.ListModelsRequest;
import org.memtrack.v1.ServerServiceGrpc;
import org.memtrack.video.Film;

/** Calls one detection server; safe for threads. */
public final class DetectionClient implements AutoCloseable {
    /** Version of the contract this client speaks. */
    public static final int PROTOCOL = 1;

    private static final Duration CONTROL_DEADLINE = Duration.ofSeconds(30);
    /** Longest silence of the server in a film: loading a model or one pass over a huge film may take a while. */
    private static final Duration IDLE_LIMIT = Duration.ofSeconds(120);

    private final ManagedChannel channel;
    private final Duration idleLimit;

    /** A client of the server at a host and port, showing the given token with each call. */
    public static DetectionClient connect(String host, int port, String token) {
        return new DetectionClient(Channels.open(host, port, token), IDLE_LIMIT);
    }

    DetectionClient(ManagedChannel channel, Duration idleLimit) {
        this.channel = channel;
        this.idleLimit = idleLimit;
    }

    /**
     * What the server says of itself.
     *
     * @param testDevices also to run one operation on each device, which may take some seconds
     * @throws DetectorException when it does not answer within 30 s, or speaks another version of the contract
     */
    public ServerInfo info(boolean testDevices) {
        GetServerInfoRequest request =
                GetServerInfoRequest.newBuilder().setTestDevices(testDevices).build();
        GetServerInfoResponse response = call(stub -> stub.getServerInfo(request));
        if (response.getProtocol() != PROTOCOL) {
            throw new DetectorException(("The server (memtrack %s) speaks version %d of the protocol and this plug-in"
                            + " version %d: update the older of the two.")
                    .formatted(response.getVersion(), response.getProtocol(), PROTOCOL));
        }
        return Messages.info(response);
    }

    /**
     * The models the server has, newest version of each name first.
     *
     * @throws DetectorException when it does not answer within 30 s
     */
    public List<ModelCard> models() {
        return call(stub -> stub.listModels(ListModelsRequest.getDefaultInstance())).getModelsList().stream()
                .map(Messages::card)
                .toList();
    }

    /**
     * Detects in a film. The film is read in the calling thread, frame by frame as the server takes them.
     *
     * @param film read once, from frame 0 to the last
     * @param settings what to detect with
     * @param progress told where the work stands, asked whether to go on
     * @throws DetectorException when the server refuses or fails, falls silent, or breaks the contract
     * @throws CancellationException when progress was cancelled, within a second
     */
    public DetectionResult detect(Film film, DetectionSettings settings, Progress progress) {
        return new DetectionCall(channel, film, settings, progress, idleLimit).run();
    }

    /** Closes the connection; calls that still run fail. */
    @Override
    public void close() {
        channel.shutdownNow();
    }

    private interface Control<T> {
        T on(ServerServiceGrpc.ServerServiceBlockingStub stub);
    }

    private <T> T call(Control<T> control) {
        try {
            return control.on(ServerServiceGrpc.newBlockingStub(channel)
                    .withDeadlineAfter(CONTROL_DEADLINE.toMillis(), TimeUnit.MILLISECONDS));
        } catch (StatusRuntimeException e) {
            throw Failures.of(Status.fromThrowable(e));
        }
    }
}
