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

    @BeforeEach
    void anEarlierRun() throws Exception {
        first = Files.writeString(folder.resolve("first"), "earlier");
        second = folder.resolve("second");
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
    void whenOneCannotBeMovedNoneOfTheRunIsLeft() throws Exception {
        Files.createDirectories(second.resolve("held by another program"));
        try (StagedFiles staged = new StagedFiles(folder)) {
            Files.writeString(staged.of(first), "new");
            Files.writeString(staged.of(second), "new too");
            assertThatThrownBy(() -> staged.moveTo(List.of(first, second))).isInstanceOf(IOException.class);
        }
        assertThat(first).doesNotExist();
        assertThat(folder.toFile().list()).containsExactly("second");
    }
}
