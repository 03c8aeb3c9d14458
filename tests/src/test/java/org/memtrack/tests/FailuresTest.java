// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Path;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.tests.Session.Outcome;

/** What can go wrong ends the macro with one sentence, and the next run works. */
@Timeout(600)
class FailuresTest {
    private static final String GREY = "newImage(\"film\", \"8-bit noise\", 64, 48, 1, 1, 8);\n";

    @TempDir
    static Path folder;

    private static Path film;

    @BeforeAll
    static void makeALongFilm() throws Exception {
        film = folder.resolve("long.tif");
        SwimmersFilm.save(film, 150, 320, 240);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    ''                                                | ''                     | No film is open
                    newImage("rgb", "RGB", 64, 48, 1);                | ''                     | colour image
                    newImage("avi", "8-bit", 64, 48, 9);              | ''                     | frames=z
                    newImage("zt", "8-bit", 64, 48, 1, 3, 4);         | ''                     | Z Project
                    newImage("g", "8-bit", 64, 48, 1, 1, 8);          | channel=2              | channel 2
                    newImage("g", "8-bit", 64, 48, 1, 1, 8);          | last_frame=9           | 1 to 8 instead of 1 to 9
                    newImage("g", "8-bit", 64, 48, 1, 1, 8);          | thresold=0.5           | "thresold" is no option
                    newImage("g", "8-bit", 64, 48, 1, 1, 8);          | criterion=best         | [maximum precision]
                    newImage("g", "8-bit", 64, 48, 1, 1, 8); x = "agar"; | preset=&x           | Medium (preset) cannot be "agar"
                    newImage("g", "8-bit", 64, 48, 1, 1, 8);          | preset=&x              | no variable x
                    newImage("g", "8-bit", 64, 48, 1, 1, 8);          | model=nonesuch         | nonesuch
                    newImage("g", "8-bit", 64, 48, 1, 1, 8);          | python=/no/such/python | There is no Python
                    newImage("g", "8-bit", 64, 48, 1, 1, 8);          | server=127.0.0.1:1     | cannot be reached
                    newImage("g", "8-bit", 64, 48, 1, 1, 8);          | server=nowhere         | host:port
                    newImage("g", "8-bit", 64, 48, 1, 1, 8); makeLine(1, 1, 9, 9, 9, 1); | ''  | no area
                    """)
    void badInputIsOneSentence(String open, String options, String expected) throws Exception {
        Outcome outcome =
                Session.run(open + "run(\"MEMTrack Track\", \"output=[%s] %s\");".formatted(folder, options), "");
        assertThat(outcome.aborted()).isTrue();
        assertThat(outcome.sentence()).contains(expected).endsWith(".");
    }

    @Test
    void withoutAFolderNothingIsDone() throws Exception {
        Outcome outcome = Session.run(GREY + "run(\"MEMTrack Track\", \"preset=water\");", "");
        assertThat(outcome.aborted()).isTrue();
        assertThat(outcome.sentence()).contains("output=[/path/to/folder]");
        assertThat(Session.run(GREY + "run(\"MEMTrack Track\");", "").sentence())
                .contains("output=");
    }

    @Test
    void aProgramThatIsNoPythonIsToldSo() throws Exception {
        String java = ProcessHandle.current().info().command().orElseThrow();
        Outcome outcome =
                Session.run(GREY + "run(\"MEMTrack Track\", \"output=[%s] python=[%s]\");".formatted(folder, java), "");
        assertThat(outcome.aborted()).isTrue();
        assertThat(outcome.sentence()).contains(java).contains("as given");
    }

    @Test
    void escapeEndsARunWithinTwoSeconds() throws Exception {
        Path output = folder.resolve("cancelled");
        CompletableFuture<Outcome> run = start(output);
        waitUntilTheServerWorks();
        long pressed = System.nanoTime();
        Session.escape();
        Outcome outcome = run.get(30, TimeUnit.SECONDS);
        assertThat(System.nanoTime() - pressed).isLessThan(TimeUnit.SECONDS.toNanos(2));
        assertThat(outcome.aborted()).isTrue();
        assertThat(outcome.sentence()).isEqualTo("MEMTrack: Cancelled.");
        assertThat(output).isEmptyDirectory();
    }

    @Test
    void aFailureEndsTheMacroThere() throws Exception {
        Path after = folder.resolve("after.txt");
        Session.run("run(\"MEMTrack Track\", \"\"); File.saveString(\"\", \"%s\");".formatted(after), "");
        assertThat(after).doesNotExist();
    }

    @Test
    void aServerThatIsKilledIsToldAndTheNextRunStartsAnother() throws Exception {
        Path output = folder.resolve("killed");
        CompletableFuture<Outcome> run = start(output);
        ProcessHandle server = waitUntilTheServerWorks();
        server.destroyForcibly();
        Outcome outcome = run.get(30, TimeUnit.SECONDS);
        assertThat(outcome.aborted()).isTrue();
        assertThat(outcome.sentence())
                .contains("The server ended while it worked (exit code")
                .contains("run again");
        assertThat(output).isEmptyDirectory();

        Outcome next = Session.run(FilmMacro.of(film, "output=[%s] last_frame=10".formatted(output)), film.toString());
        assertThat(next.aborted()).isFalse();
        assertThat(Session.server().pid()).isNotEqualTo(server.pid());
    }

    private static CompletableFuture<Outcome> start(Path output) {
        Session.forget();
        return CompletableFuture.supplyAsync(() -> {
            try {
                return Session.run(FilmMacro.of(film, "output=[%s]".formatted(output)), film.toString());
            } catch (Exception e) {
                throw new IllegalStateException(e);
            }
        });
    }

    /** The film has arrived when the server tells of its next step. */
    private static ProcessHandle waitUntilTheServerWorks() throws Exception {
        // A server is given 120 s to start.
        long end = System.nanoTime() + TimeUnit.SECONDS.toNanos(200);
        while (System.nanoTime() < end) {
            Thread.sleep(50);
            if (Session.log().contains("Stabilising")) {
                return Session.server();
            }
        }
        throw new AssertionError("The server did not begin to work");
    }
}
