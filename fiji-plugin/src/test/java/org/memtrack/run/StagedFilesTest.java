// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class StagedFilesTest {
    @TempDir
    Path folder;

    private Path first;
    private Path second;
    private Path nowhere;

    @BeforeEach
    void anEarlierRun() throws Exception {
        first = Files.writeString(folder.resolve("first"), "earlier");
        second = folder.resolve("second");
        nowhere = folder.resolve("gone").resolve("nowhere");
    }

    @Test
    void nothingIsInItsPlaceBeforeAllIsWritten() throws Exception {
        try (StagedFiles staged = new StagedFiles(folder)) {
            Files.writeString(staged.of(first), "new");
            Files.writeString(staged.of(second), "new too");
            assertThat(first).hasContent("earlier");
            assertThat(second).doesNotExist();
            staged.moveTo(List.of(first, second));
        }
        assertThat(first).hasContent("new");
        assertThat(second).hasContent("new too");
        assertThat(folder.toFile().list()).hasSize(2);
    }

    @Test
    void whenOneCannotBeMovedTheEarlierOnesAreInTheirPlacesAndTheNewOnesCanBeKept() throws Exception {
        Path kept;
        try (StagedFiles staged = new StagedFiles(folder)) {
            Files.writeString(staged.of(first), "new");
            Files.writeString(staged.of(nowhere), "new too");
            assertThatThrownBy(() -> staged.moveTo(List.of(first, nowhere))).isInstanceOf(IOException.class);
            kept = staged.keep();
        }
        assertThat(first).hasContent("earlier");
        assertThat(kept.toFile().list()).containsExactlyInAnyOrder("first", "nowhere");
        assertThat(kept.resolve("first")).hasContent("new");
        assertThat(kept.resolve("nowhere")).hasContent("new too");
    }

    @Test
    void whatIsNotKeptIsDeletedWhenItCannotBeMoved() throws Exception {
        try (StagedFiles staged = new StagedFiles(folder)) {
            Files.writeString(staged.of(first), "new");
            Files.writeString(staged.of(nowhere), "new too");
            assertThatThrownBy(() -> staged.moveTo(List.of(first, nowhere))).isInstanceOf(IOException.class);
        }
        assertThat(first).hasContent("earlier");
        assertThat(folder.toFile().list()).containsExactly("first");
    }

    @Test
    void anEarlierFileGoesAlsoWhereThereIsNoNewOne() throws Exception {
        try (StagedFiles staged = new StagedFiles(folder)) {
            Files.writeString(staged.of(second), "new");
            staged.moveTo(List.of(first, second));
        }
        assertThat(folder.toFile().list()).containsExactly("second");
    }

    @Test
    void aFolderThatCannotBeCleanedUpIsNoFailure() throws Exception {
        StagedFiles staged = new StagedFiles(folder);
        Files.writeString(staged.of(first), "new");
        staged.moveTo(List.of(first));
        // Another program, a virus scanner for one, was faster.
        Path aside = staged.of(first).getParent();
        Files.delete(aside.resolve("earlier").resolve("first"));
        Files.delete(aside.resolve("earlier"));
        Files.delete(aside);
        staged.close();
        assertThat(first).hasContent("new");
    }
}
