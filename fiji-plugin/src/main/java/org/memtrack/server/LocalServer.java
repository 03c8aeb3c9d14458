// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import com.google.gson.Gson;
import com.google.gson.JsonParseException;
import java.io.EOFException;
import java.io.File;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import java.security.SecureRandom;
import java.time.Duration;
import java.util.HexFormat;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.regex.Pattern;
import org.memtrack.client.DetectionClient;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/** A server process of our own: started, listened to and ended. */
final class LocalServer {
    /** The first start after an installation compiles everything, on some disks under a virus scanner. */
    private static final Duration START_LIMIT = Duration.ofSeconds(120);

    /** Lines worth telling the user; the rest of what a server logs is no reason for its end. */
    private static final Pattern TROUBLE = Pattern.compile("Error|ERROR|CRITICAL|Fatal|terminate called");

    private final Process process;
    private final Interpreter interpreter;
    private final Tail errors;
    private final Greeting greeting;
    private final String token;

    /** The line of JSON the server prints when it is ready. */
    private record Greeting(int protocol, int port, long pid, String version) {}

    private LocalServer(Process process, Interpreter interpreter, Tail errors, Greeting greeting, String token) {
        this.process = process;
        this.interpreter = interpreter;
        this.errors = errors;
        this.greeting = greeting;
        this.token = token;
    }

    /**
     * Starts a server and waits until it is ready.
     *
     * @throws StartException when this Python cannot; another one may
     * @throws DetectorException when it can, but speaks another version of the contract
     * @throws CancellationException when progress was cancelled; the process is ended
     */
    static LocalServer start(Interpreter interpreter, Progress progress) throws StartException {
        return start(interpreter, progress, START_LIMIT);
    }

    static LocalServer start(Interpreter interpreter, Progress progress, Duration limit) throws StartException {
        String token = HexFormat.of().formatHex(randomBytes());
        ProcessBuilder builder = interpreter.process(
                "-m",
                "memtrack",
                "serve",
                "--token-from-stdin",
                "--parent-pid",
                Long.toString(ProcessHandle.current().pid()));
        builder.directory(workingFolder());
        Process process;
        try {
            process = builder.start();
        } catch (IOException e) {
            throw new StartException("%s could not be run: %s".formatted(interpreter.describe(), e.getMessage()), e);
        }
        CompletableFuture<Greeting> greeting = new CompletableFuture<>();
        Tail errors = new Tail("memtrack-server-errors", process.getErrorStream(), line -> {});
        Tail output = new Tail("memtrack-server-output", process.getInputStream(), line -> greet(line, greeting));
        boolean started = false;
        try {
            // Left open: its end tells the server that ImageJ has ended.
            OutputStream stdin = process.getOutputStream();
            stdin.write((token + "\n").getBytes(StandardCharsets.UTF_8));
            stdin.flush();
            Greeting said = await(greeting, process, progress, limit);
            checkProtocol(said, interpreter);
            started = true;
            return new LocalServer(process, interpreter, errors, said, token);
        } catch (IOException | TimeoutException e) {
            end(process);
            String what =
                    e instanceof TimeoutException ? "did not start within %d s".formatted(limit.toSeconds()) : "ended";
            throw new StartException(reason(interpreter, what, errors, output), e);
        } finally {
            if (!started) {
                end(process);
            }
        }
    }

    boolean alive() {
        return process.isAlive();
    }

    Interpreter interpreter() {
        return interpreter;
    }

    DetectionClient connect() {
        return DetectionClient.connect("127.0.0.1", greeting.port, token);
    }

    /** How the process ended, as one sentence with its last words; empty while it runs. */
    Optional<String> death() {
        try {
            // The connection breaks a moment before the process is gone.
            if (!process.waitFor(500, TimeUnit.MILLISECONDS)) {
                return Optional.empty();
            }
            errors.finish();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return Optional.empty();
        }
        String words = errors.lines().stream()
                .filter(line -> TROUBLE.matcher(line).find())
                .reduce("", (first, second) -> "; its last words: " + second.strip());
        return Optional.of(
                ("The server ended while it worked (exit code %d%s): run again, and if memory is short, close"
                                + " other programs or crop the film.")
                        .formatted(process.exitValue(), words));
    }

    /** Asks the process to end, and makes it end within a few seconds. */
    void end() {
        end(process);
    }

    /** The user's home, or where an account has none, as that of a service or of a container, the folder of temporary files. */
    private static File workingFolder() {
        File home = new File(System.getProperty("user.home", ""));
        return home.isDirectory() ? home : new File(System.getProperty("java.io.tmpdir"));
    }

    private static void greet(String line, CompletableFuture<Greeting> greeting) {
        if (!line.startsWith("{")) {
            return;
        }
        try {
            Greeting said = new Gson().fromJson(line, Greeting.class);
            if (said.port > 0) {
                greeting.complete(said);
            }
        } catch (JsonParseException e) {
            // Some other line; the greeting may still come.
        }
    }

    /** @throws IOException when the process ended without a greeting */
    private static Greeting await(
            CompletableFuture<Greeting> greeting, Process process, Progress progress, Duration limit)
            throws IOException, TimeoutException {
        long end = System.nanoTime() + limit.toNanos();
        while (System.nanoTime() < end) {
            progress.throwIfCancelled();
            boolean alive = process.isAlive();
            try {
                return greeting.get(100, TimeUnit.MILLISECONDS);
            } catch (TimeoutException e) {
                if (!alive) {
                    throw new EOFException("it ended without a greeting");
                }
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
                throw new CancellationException("Interrupted.");
            } catch (ExecutionException e) {
                throw new IllegalStateException(e);
            }
        }
        throw new TimeoutException();
    }

    private static void checkProtocol(Greeting said, Interpreter interpreter) {
        if (said.protocol != DetectionClient.PROTOCOL) {
            throw new DetectorException(("The server of %s (memtrack %s) speaks version %d of the protocol and this"
                            + " plug-in version %d: run \"MEMTrack Install Python Environment\" to bring both in step.")
                    .formatted(interpreter.describe(), said.version, said.protocol, DetectionClient.PROTOCOL));
        }
    }

    private static String reason(Interpreter interpreter, String what, Tail errors, Tail output) {
        errors.finish();
        output.finish();
        List<String> lines = errors.lines();
        if (lines.stream().anyMatch(line -> line.endsWith("No module named memtrack"))) {
            return interpreter.describe() + " has no package memtrack";
        }
        String words = !lines.isEmpty()
                // A shim of pyenv says what is wrong first and goes on with advice; Python says it last.
                ? lines.stream()
                        .filter(line -> line.startsWith("pyenv: "))
                        .findFirst()
                        .orElseGet(() -> last(lines))
                : output.lines().isEmpty() ? "it said nothing" : "it said \"" + last(output.lines()) + "\"";
        String clause = words.replaceAll("[.\\s]+$", "");
        return "the server of %s %s: %s".formatted(interpreter.describe(), what, clause);
    }

    private static String last(List<String> lines) {
        return lines.stream()
                .filter(line -> !line.isBlank())
                .reduce("", (first, second) -> second)
                .strip();
    }

    private static void end(Process process) {
        try {
            process.getOutputStream().close();
        } catch (IOException e) {
            // The process has closed its side.
        }
        try {
            if (!process.waitFor(3, TimeUnit.SECONDS)) {
                process.destroy();
                if (!process.waitFor(2, TimeUnit.SECONDS)) {
                    process.destroyForcibly();
                }
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            process.destroyForcibly();
        }
    }

    private static byte[] randomBytes() {
        byte[] bytes = new byte[32];
        new SecureRandom().nextBytes(bytes);
        return bytes;
    }
}
