// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.grpc.InsecureServerCredentials;
import io.grpc.Server;
import io.grpc.Status;
import io.grpc.okhttp.OkHttpServerBuilder;
import io.grpc.stub.StreamObserver;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;
import org.memtrack.v1.GetServerInfoRequest;
import org.memtrack.v1.GetServerInfoResponse;
import org.memtrack.v1.ServerServiceGrpc;

/** Scripts in place of the server's process. */
@Timeout(60)
class ManagedServerTest {
    @TempDir
    Path folder;

    private final ManagedServer managed = new ManagedServer(Duration.ofMinutes(1), Optional::empty);

    @Test
    void aServerInUseIsNotReplacedWhenItIsTooBusyToAnswer() throws Exception {
        AtomicBoolean busy = new AtomicBoolean();
        Server server = serving(busy);
        List<Interpreter> python = List.of(greeting(server));
        try (ServerConnection first = managed.acquire(python, Progress.NONE)) {
            busy.set(true);
            try (ServerConnection second = managed.acquire(python, Progress.NONE)) {
                assertThat(second.client()).isSameAs(first.client());
            }
            busy.set(false);
            assertThat(first.client().info(false).version()).isEqualTo("9.9.9");
        } finally {
            managed.end();
            server.shutdownNow();
        }
    }

    @Test
    void anInstalledServerOfAnotherBuildIsToldOfAndOneTheUserNamedIsNot() throws Exception {
        Server server = serving(new AtomicBoolean());
        ServerWheel carried = SmallWheel.of(SmallWheel.SERVER, ">=3");
        ManagedServer ofThisBuild = new ManagedServer(Duration.ofMinutes(1), () -> Optional.of(carried));
        Interpreter named = greeting(server);
        try {
            assertThat(warnings(ofThisBuild, named)).isEmpty();
            assertThat(warnings(ofThisBuild, installed(greeting(server), carried.sha256())))
                    .isEmpty();
            assertThat(warnings(ofThisBuild, installed(greeting(server), "0".repeat(64))))
                    .singleElement()
                    .asString()
                    .contains("another build");
        } finally {
            ofThisBuild.end();
            server.shutdownNow();
        }
    }

    @Test
    void aRetiredServerWorksForItsUsersUntilTheLastHasGivenItBackAndForNobodyElse() throws Exception {
        Server server = serving(new AtomicBoolean());
        List<Interpreter> python = List.of(greeting(server));
        List<Interpreter> another = List.of(greeting(server));
        try (ServerConnection first = managed.acquire(python, Progress.NONE);
                ServerConnection second = managed.acquire(python, Progress.NONE)) {
            Set<ProcessHandle> old = processes();
            managed.retire();
            assertThat(first.client().info(false).version()).isEqualTo("9.9.9");
            try (ServerConnection next = managed.acquire(another, Progress.NONE)) {
                assertThat(next.client()).isNotSameAs(first.client());
                assertThat(processes()).containsAll(old).hasSize(old.size() + 1);
                first.close();
                assertThat(second.client().info(false).version()).isEqualTo("9.9.9");
                second.close();
                assertThat(processes()).doesNotContainAnyElementsOf(old).hasSize(1);
                assertThat(next.client().info(false).version()).isEqualTo("9.9.9");
            }
            managed.retire();
            assertThat(processes()).as("nobody used it").isEmpty();
        } finally {
            managed.end();
            server.shutdownNow();
        }
    }

    @Test
    void aRetiredServerEndsWithImageJ() throws Exception {
        Server server = serving(new AtomicBoolean());
        try (ServerConnection connection = managed.acquire(List.of(greeting(server)), Progress.NONE)) {
            managed.retire();
            assertThat(processes()).isNotEmpty();
            managed.close();
            assertThat(processes()).isEmpty();
            assertThatThrownBy(() -> connection.client().info(false)).isInstanceOf(DetectorException.class);
        } finally {
            server.shutdownNow();
        }
    }

    private static Server serving(AtomicBoolean busy) throws IOException {
        return OkHttpServerBuilder.forPort(0, InsecureServerCredentials.create())
                .addService(answering(busy))
                .build()
                .start();
    }

    /** The scripts of this test that run. */
    private Set<ProcessHandle> processes() {
        return ProcessHandle.current()
                .descendants()
                .filter(process -> process.info().commandLine().orElse("").contains(folder.toString()))
                .collect(Collectors.toSet());
    }

    private static List<String> warnings(ManagedServer managed, Interpreter python) {
        try (ServerConnection connection = managed.acquire(List.of(python), Progress.NONE)) {
            return connection.warnings();
        }
    }

    private Interpreter installed(Interpreter python, String wheelSha256) {
        return new Interpreter(
                python.command(), "installed by MEMTrack", new PythonEnvironment(folder, "9.9.9", wheelSha256));
    }

    @Test
    void theEndOfImageJDoesNotWaitForAServerThatIsStarting() throws Exception {
        Path started = folder.resolve("started");
        Interpreter silent = script("import sys; open(r'%s', 'w').close(); sys.stdin.read()".formatted(started));
        CompletableFuture<ServerConnection> run =
                CompletableFuture.supplyAsync(() -> managed.acquire(List.of(silent), Progress.NONE));
        while (!Files.exists(started)) {
            Thread.sleep(10);
        }
        managed.close();
        assertThatThrownBy(() -> run.get(1, TimeUnit.SECONDS)).hasCauseInstanceOf(CancellationException.class);
    }

    private static ServerServiceGrpc.ServerServiceImplBase answering(AtomicBoolean busy) {
        return new ServerServiceGrpc.ServerServiceImplBase() {
            @Override
            public void getServerInfo(GetServerInfoRequest request, StreamObserver<GetServerInfoResponse> answer) {
                if (busy.get()) {
                    answer.onError(Status.DEADLINE_EXCEEDED.asRuntimeException());
                } else {
                    answer.onNext(GetServerInfoResponse.newBuilder()
                            .setProtocol(1)
                            .setVersion("9.9.9")
                            .build());
                    answer.onCompleted();
                }
            }
        };
    }

    /** Leads to a server that runs already. */
    private Interpreter greeting(Server server) throws Exception {
        return script("""
                import json, sys
                print(json.dumps({"protocol": 1, "port": %d, "pid": 1, "version": "9.9.9"}), flush=True)
                sys.stdin.read()
                """.formatted(server.getPort()));
    }

    private Interpreter script(String code) throws Exception {
        Path file = Files.writeString(Files.createTempFile(folder, "server", ".py"), code);
        String python =
                Interpreters.onThisMachine(System.getenv()).get(0).command().get(0);
        return new Interpreter(List.of(python, file.toString()), "as given", null);
    }
}
