// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.detection.DetectorException;

class ResultFilesTest {
    @TempDir
    Path folder;

    @Test
    void theFolderIsMadeAndNothingIsLeftInIt() throws Exception {
        Path made = folder.resolve("ä [1]").resolve("细菌 b");
        ResultFiles files = ResultFiles.in(made, "my film.tif");
        assertThat(files.xml()).isEqualTo(made.resolve("my film.xml"));
        assertThat(files.all()).hasSize(6).doesNotHaveDuplicates();
        assertThat(made).isEmptyDirectory();
    }

    @Test
    void filesOfTheUserAreNotOverwritten() throws Exception {
        Files.writeString(folder.resolve("film.mdf"), "tracked by hand for a week");
        assertThatThrownBy(() -> ResultFiles.in(folder, "film.tif"))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("film.mdf");
        Files.writeString(folder.resolve("film.json"), "not ours either");
        assertThatThrownBy(() -> ResultFiles.in(folder, "film.tif")).isInstanceOf(DetectorException.class);
    }

    @Test
    void aFolderThatIsAFileIsRefused() throws Exception {
        Path file = Files.writeString(folder.resolve("file"), "x");
        assertThatThrownBy(() -> ResultFiles.in(file, "film.tif"))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining(file.toString())
                .hasMessageContaining("choose another one");
    }

    @ParameterizedTest
    @CsvSource({
        "film.tif, film",
        "film.avi, film",
        "a.b.TIFF, a.b",
        "a/b:c, a_b_c",
        ".., film",
        "'  ', film",
        "细菌.tif, 细菌"
    })
    void namesAreThoseOfTheFilmWithoutWhatFileSystemsRefuse(String title, String expected) {
        assertThat(ResultFiles.baseName(title)).isEqualTo(expected);
    }
}
