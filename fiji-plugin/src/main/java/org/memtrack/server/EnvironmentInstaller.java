// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.nio.channels.FileChannel;
import java.nio.channels.OverlappingFileLockException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.time.Duration;
import java.time.LocalDateTime;
import java.time.format.DateTimeFormatter;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/**
 * Makes the Python environment of the server in the data folder: a plain venv, or on a machine without Python a copy of one
 * that a jar carries, with the wheel of the plug-in's jar in it. An
 * environment is in use only when it is complete and its server has answered; until then the older one is.
 *
 * <p>The one that was in use before stays until the next installation, since the server of another ImageJ may run in it;
 * that the server of another ImageJ runs in a still older one is not looked for.
 */
public final class EnvironmentInstaller {
    private static final Duration LIMIT = Duration.ofMinutes(90);
    private static final long BASE_BYTES = 2L << 30;
    private static final long TRAINING_BYTES = 10L << 30;

    /** As {@link #make} names an environment. */
    private static final Pattern NAME = Pattern.compile("env-[^-]+-\\d{8}-\\d{6}");

    /** Folder of an environment that holds the wheel: made first, it tells that the environment is one of ours. */
    private static final String PARCELS = "memtrack-wheel";

    private final Path dataFolder;
    private final ServerWheel wheel;
    private final Map<String, String> environment;
    private final Optional<CarriedPython> carried;

    /** An installer of the jar's own server into the user's data folder. */
    public EnvironmentInstaller() {
        this(DataFolder.path(), ServerWheel.fromJar(), System.getenv(), CarriedPython.find());
    }

    EnvironmentInstaller(
            Path dataFolder, ServerWheel wheel, Map<String, String> environment, Optional<CarriedPython> carried) {
        this.dataFolder = dataFolder;
        this.wheel = wheel;
        this.environment = environment;
        this.carried = carried;
    }

    /**
     * Makes a new environment and puts it into use in place of an older one.
     *
     * @param python to make it with; null to look for one on this machine, then in a jar beside the plug-in's
     * @param training whether to install what training needs, too: PyTorch and nncf
     * @throws DetectorException when it cannot be made; the older one, if any, is in use as before
     * @throws CancellationException when progress was cancelled; likewise
     */
    public PythonEnvironment install(@Nullable Path python, boolean training, Progress progress) {
        try {
            Files.createDirectories(dataFolder);
            checkSpace(training ? TRAINING_BYTES : BASE_BYTES);
            try (FileChannel channel = FileChannel.open(
                    dataFolder.resolve("install.lock"), StandardOpenOption.CREATE, StandardOpenOption.WRITE)) {
                lock(channel);
                return make(start(python, progress), training, progress);
            }
        } catch (IOException e) {
            throw new DetectorException(
                    "The environment cannot be made in %s (%s): check the folder, or name another one in MEMTRACK_HOME."
                            .formatted(dataFolder, e.getMessage()),
                    e);
        }
    }

    /** The jar whose Python stands in where this machine has none. */
    public static Optional<Path> carriedPython() {
        return CarriedPython.find().map(CarriedPython::jar);
    }

    /** What pip and the others printed in the last installation. */
    public Path log() {
        return dataFolder.resolve("install.log");
    }

    /** Given back when the channel is closed, or the process ends. */
    private void lock(FileChannel channel) throws IOException {
        boolean free;
        try {
            free = channel.tryLock() != null;
        } catch (OverlappingFileLockException inThisProcess) {
            free = false;
        }
        if (!free) {
            throw new DetectorException(
                    "Another installation into %s is at work: wait for it to end.".formatted(dataFolder));
        }
    }

    /** A venv of the Python that was named, or else of one on this machine; without any, a copy of one carried by a jar. */
    private EnvironmentStart start(@Nullable Path python, Progress progress) {
        progress.report("Looking for Python", 0, OptionalDouble.empty(), "");
        List<String> objections = new ArrayList<>();
        Optional<Interpreter> base = BasePython.choose(
                python == null
                        ? Interpreters.onThisMachine(environment)
                        : Interpreters.candidates(python, environment, python),
                objections,
                progress);
        if (base.isPresent()) {
            return (folder, part) ->
                    step("making the environment", base.get().process("-m", "venv", folder.toString()), part);
        }
        if (python == null && carried.isPresent()) {
            return carried.get();
        }
        throw BasePython.none(objections);
    }

    PythonEnvironment make(EnvironmentStart start, boolean training, Progress progress) throws IOException {
        Files.deleteIfExists(log());
        String stamp = LocalDateTime.now().format(DateTimeFormatter.ofPattern("yyyyMMdd-HHmmss"));
        Path folder = dataFolder.resolve("env-" + wheel.version() + "-" + stamp);
        PythonEnvironment made = new PythonEnvironment(folder, wheel.version(), wheel.sha256());
        Optional<PythonEnvironment> before = PythonEnvironment.installed(dataFolder);
        boolean complete = false;
        try {
            progress.report("Making the environment", 0.02, OptionalDouble.empty(), folder.toString());
            Path parcels = folder.resolve(PARCELS);
            wheel.writeTo(parcels);
            start.make(folder, progress.between(0.02, 0.1));
            ProcessBuilder pip = made.interpreter()
                    .process(
                            "-m",
                            "pip",
                            "install",
                            "--no-input",
                            "--disable-pip-version-check",
                            "--no-warn-script-location",
                            "--progress-bar=off",
                            // By its bare name: pip would read a bracket in a path as an extra.
                            wheel.fileName() + (training ? "[train]" : ""))
                    .directory(parcels.toFile());
            progress.report("Installing", 0.1, OptionalDouble.empty(), "");
            step("installing the packages", pip, progress.between(0.1, 0.9));
            progress.report("Trying the server", 0.9, OptionalDouble.empty(), "");
            tryServer(made, progress);
            made.use(dataFolder);
            complete = true;
        } finally {
            if (!complete) {
                Folders.tryDelete(folder);
            }
        }
        Servers.retire();
        deleteOlder(folder, before.map(PythonEnvironment::folder).orElse(folder));
        progress.report("Installed", 1, OptionalDouble.empty(), folder.toString());
        return made;
    }

    /**
     * Deletes our environments but the new one and the one before, also what is left of an installation that was killed. The
     * data folder may be one of the user's own, with other things in it that begin with "env-".
     */
    private void deleteOlder(Path made, Path before) throws IOException {
        List<Path> older;
        try (Stream<Path> all = Files.list(dataFolder)) {
            older = all.filter(folder ->
                            NAME.matcher(folder.getFileName().toString()).matches())
                    .filter(folder -> Files.isDirectory(folder.resolve(PARCELS)))
                    .filter(folder -> !folder.equals(made) && !folder.equals(before))
                    .toList();
        }
        older.forEach(Folders::tryDelete);
    }

    private void step(String doing, ProcessBuilder builder, Progress part) throws IOException {
        List<String> said = Collections.synchronizedList(new ArrayList<>());
        AtomicInteger lines = new AtomicInteger();
        Progress polled = new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {}

            @Override
            public boolean cancelled() {
                int count = said.size();
                if (count > lines.getAndSet(count)) {
                    // How many lines pip will print is not known; the bar never stands still and never arrives.
                    part.report(
                            "Installing",
                            1 - Math.exp(-count / 40.0),
                            OptionalDouble.empty(),
                            said.get(count - 1).strip());
                }
                return part.cancelled();
            }
        };
        WatchedProcess.End ended;
        try {
            ended = WatchedProcess.run(builder, polled, said::add, LIMIT);
        } catch (TimeoutException e) {
            throw new DetectorException(
                    "Python %s while %s: check the network and run this command again; all it said is in %s."
                            .formatted(e.getMessage(), doing, log()),
                    e);
        } finally {
            Files.write(
                    log(), copyOf(said), StandardCharsets.UTF_8, StandardOpenOption.CREATE, StandardOpenOption.APPEND);
        }
        if (ended.exitCode() != 0) {
            throw new DetectorException(
                    "Python failed while %s (%s): mend that and run this command again; all it said is in %s."
                            .formatted(doing, InstallFailures.cause(ended.lines()), log()));
        }
    }

    /** Of a synchronised list, which what a program left running may still add to. */
    private static List<String> copyOf(List<String> said) {
        synchronized (said) {
            return List.copyOf(said);
        }
    }

    private static void tryServer(PythonEnvironment made, Progress progress) {
        try {
            LocalServer.start(made.interpreter(), progress).end();
        } catch (StartException e) {
            throw new DetectorException(
                    "The environment was made but does not work, since %s: please report this."
                            .formatted(e.getMessage()),
                    e);
        }
    }

    private void checkSpace(long wanted) throws IOException {
        long free = Files.getFileStore(dataFolder).getUsableSpace();
        if (free < wanted) {
            throw new DetectorException(
                    "%s has %.1f GB of free space and the environment may need %.0f GB: make room, or name"
                                    .formatted(dataFolder, free / 1e9, wanted / 1e9)
                            + " a folder on another disk in MEMTRACK_HOME.");
        }
    }
}
