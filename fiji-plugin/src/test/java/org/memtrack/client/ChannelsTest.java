// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import static org.assertj.core.api.Assertions.assertThat;
import static org.memtrack.client.ScriptedServer.accepted;
import static org.memtrack.client.ScriptedServer.frame;
import static org.memtrack.client.ScriptedServer.summary;

import io.grpc.InsecureServerCredentials;
import io.grpc.ManagedChannel;
import io.grpc.Server;
import io.grpc.okhttp.OkHttpServerBuilder;
import java.time.Duration;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.memtrack.v1.DetectFilmResponse;
import org.memtrack.video.SampleType;

/** A channel through the loopback, unlike the others' in-process ones, which know no limits. */
class ChannelsTest {
    @Test
    void aFrameOfVeryManyBoxesComesThrough() throws Exception {
        DetectFilmResponse.Builder crowd = frame(150_000).toBuilder();
        crowd.getFrameBuilder().setFrame(0);
        DetectFilmResponse answer = crowd.build();
        assertThat(answer.getSerializedSize()).as("gRPC's own limit").isGreaterThan(4 << 20);
        ScriptedServer service = new ScriptedServer(responses -> {
            responses.onNext(accepted());
            responses.onNext(answer);
            responses.onNext(summary(1));
            responses.onCompleted();
        });
        Server server = OkHttpServerBuilder.forPort(0, InsecureServerCredentials.create())
                .addService(service)
                .build()
                .start();
        ManagedChannel channel = Channels.open("127.0.0.1", server.getPort(), "token");
        try (service) {
            DetectionResult result = new DetectionClient(channel, Duration.ofSeconds(30))
                    .detect(new SyntheticFilm(7, 5, 1, SampleType.UINT8), DetectionSettings.DEFAULTS, Progress.NONE);
            assertThat(result.frames().get(0).detections()).hasSize(150_000);
        } finally {
            channel.shutdownNow().awaitTermination(5, TimeUnit.SECONDS);
            server.shutdownNow().awaitTermination(5, TimeUnit.SECONDS);
        }
    }
}
