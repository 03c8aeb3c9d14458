// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.sun.net.httpserver.HttpServer;
import io.grpc.InsecureServerCredentials;
import io.grpc.ManagedChannel;
import io.grpc.Metadata;
import io.grpc.Server;
import io.grpc.ServerCall;
import io.grpc.ServerCallHandler;
import io.grpc.ServerInterceptor;
import io.grpc.Status;
import io.grpc.TlsServerCredentials;
import io.grpc.okhttp.OkHttpChannelBuilder;
import io.grpc.okhttp.OkHttpServerBuilder;
import io.grpc.stub.StreamObserver;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;
import java.nio.charset.Charset;
import java.nio.file.Path;
import java.security.KeyStore;
import java.time.Duration;
import javax.net.ssl.KeyManager;
import javax.net.ssl.KeyManagerFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.detection.DetectorException;
import org.memtrack.v1.GetServerInfoRequest;
import org.memtrack.v1.GetServerInfoResponse;
import org.memtrack.v1.ServerServiceGrpc;

/** The handshake, over a real socket. */
@Timeout(600)
class ServerInfoTest {
    @TempDir
    Path folder;

    @Test
    void aServerOfOurProtocolIsAcceptedWithItsToken() throws Exception {
        try (Running running = new Running(1);
                DetectionClient client = DetectionClient.connect("127.0.0.1", running.port(), "secret")) {
            ServerInfo info = client.info(true);
            assertThat(info.version()).isEqualTo("9.9.9");
            assertThat(info.devices()).containsExactly("tested");
        }
    }

    @Test
    void anotherTokenIsRefused() throws Exception {
        try (Running running = new Running(1);
                DetectionClient client = DetectionClient.connect("127.0.0.1", running.port(), "guess")) {
            assertThatThrownBy(() -> client.info(false))
                    .isInstanceOf(DetectorException.class)
                    .hasMessageContaining("MEMTRACK_TOKEN");
        }
    }

    @Test
    void anotherProtocolIsRefusedWithBothVersions() throws Exception {
        try (Running running = new Running(2);
                DetectionClient client = DetectionClient.connect("127.0.0.1", running.port(), "secret")) {
            assertThatThrownBy(() -> client.info(false))
                    .isInstanceOf(DetectorException.class)
                    .hasMessageContaining("memtrack 9.9.9")
                    .hasMessageContaining("version 2")
                    .hasMessageContaining("version 1");
        }
    }

    @Test
    void aPortWhereNobodyListensIsOneSentence() throws Exception {
        int port;
        try (ServerSocket free = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            port = free.getLocalPort();
        }
        try (DetectionClient client = DetectionClient.connect("127.0.0.1", port, "secret")) {
            assertThatThrownBy(() -> client.info(false))
                    .isInstanceOf(DetectorException.class)
                    .hasMessageContaining("cannot be reached")
                    .hasMessageContaining("(Connection refused");
        }
    }

    @Test
    void aCertificateThatIsNotTrustedIsNamedAsTheCause() throws Exception {
        Server server = OkHttpServerBuilder.forPort(
                        new InetSocketAddress(InetAddress.getLoopbackAddress(), 0),
                        TlsServerCredentials.newBuilder()
                                .keyManager(ownCertificate())
                                .build())
                .build()
                .start();
        ManagedChannel channel =
                OkHttpChannelBuilder.forAddress("localhost", server.getPort()).build();
        try (DetectionClient client = new DetectionClient(channel, Duration.ofSeconds(30))) {
            assertThatThrownBy(() -> client.info(false))
                    .isInstanceOf(DetectorException.class)
                    .hasMessageContaining("cannot be reached")
                    .hasMessageContaining("(unable to find valid certification path to requested target): run again");
        } finally {
            server.shutdownNow();
        }
    }

    /** A certificate for localhost that nobody but itself has signed. */
    private KeyManager[] ownCertificate() throws Exception {
        Path file = folder.resolve("server.p12");
        Process keytool = new ProcessBuilder(
                        Path.of(System.getProperty("java.home"), "bin", "keytool")
                                .toString(),
                        "-genkeypair",
                        "-keyalg",
                        "EC",
                        "-dname",
                        "CN=localhost",
                        "-ext",
                        "san=dns:localhost",
                        "-storepass",
                        "secret",
                        "-keystore",
                        file.toString())
                .redirectErrorStream(true)
                .start();
        String said = new String(keytool.getInputStream().readAllBytes(), Charset.defaultCharset());
        assertThat(keytool.waitFor()).as(said).isZero();
        KeyManagerFactory keys = KeyManagerFactory.getInstance(KeyManagerFactory.getDefaultAlgorithm());
        keys.init(KeyStore.getInstance(file.toFile(), "secret".toCharArray()), "secret".toCharArray());
        return keys.getKeyManagers();
    }

    @Test
    void aWebServerIsNoServerOfOurs() throws Exception {
        HttpServer web = HttpServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0), 0);
        web.start();
        try (DetectionClient client =
                DetectionClient.connect("127.0.0.1", web.getAddress().getPort(), "secret")) {
            assertThatThrownBy(() -> client.info(false)).isInstanceOf(DetectorException.class);
        } finally {
            web.stop(0);
        }
    }

    private static final class Running extends ServerServiceGrpc.ServerServiceImplBase
            implements ServerInterceptor, AutoCloseable {
        private static final Metadata.Key<String> AUTHORIZATION =
                Metadata.Key.of("authorization", Metadata.ASCII_STRING_MARSHALLER);
        private final int protocol;
        private final Server server;

        Running(int protocol) throws Exception {
            this.protocol = protocol;
            server = OkHttpServerBuilder.forPort(
                            new InetSocketAddress(InetAddress.getLoopbackAddress(), 0),
                            InsecureServerCredentials.create())
                    .addService(this)
                    .intercept(this)
                    .build()
                    .start();
        }

        int port() {
            return server.getPort();
        }

        @Override
        public void getServerInfo(GetServerInfoRequest request, StreamObserver<GetServerInfoResponse> responses) {
            GetServerInfoResponse.Builder response =
                    GetServerInfoResponse.newBuilder().setProtocol(protocol).setVersion("9.9.9");
            if (request.getTestDevices()) {
                response.addDevices("tested");
            }
            responses.onNext(response.build());
            responses.onCompleted();
        }

        @Override
        public <Q, R> ServerCall.Listener<Q> interceptCall(
                ServerCall<Q, R> call, Metadata headers, ServerCallHandler<Q, R> next) {
            if (!"Bearer secret".equals(headers.get(AUTHORIZATION))) {
                call.close(Status.UNAUTHENTICATED, new Metadata());
                return new ServerCall.Listener<>() {};
            }
            return next.startCall(call, headers);
        }

        @Override
        public void close() {
            server.shutdownNow();
        }
    }
}
