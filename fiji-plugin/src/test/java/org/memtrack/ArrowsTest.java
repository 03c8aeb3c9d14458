// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack;

import static com.tngtech.archunit.library.Architectures.layeredArchitecture;
import static com.tngtech.archunit.library.dependencies.SlicesRuleDefinition.slices;
import static org.assertj.core.api.Assertions.assertThat;

import com.tngtech.archunit.ArchConfiguration;
import com.tngtech.archunit.core.domain.JavaClass;
import com.tngtech.archunit.core.domain.JavaClasses;
import com.tngtech.archunit.core.importer.ClassFileImporter;
import com.tngtech.archunit.lang.ArchRule;
import com.tngtech.archunit.lang.syntax.ArchRuleDefinition;
import java.nio.file.Path;
import java.util.Set;
import java.util.stream.Collectors;
import org.jspecify.annotations.NullMarked;
import org.junit.jupiter.api.Test;

/** Which package may use which: ui, macro -> run -> trackmate, formats, client, server -> tracking, motility, video -> detection. */
class ArrowsTest {
    static {
        // What our classes use is told by its name alone; to look into the libraries takes most of a minute.
        ArchConfiguration.get().setResolveMissingDependenciesFromClassPath(false);
    }

    /** All but what is generated from the contract. */
    private static final JavaClasses CLASSES = new ClassFileImporter()
            .withImportOption(location -> !location.contains("/org/memtrack/v1/"))
            .importPath(Path.of("target", "classes"));

    @Test
    void arrowsPointOneWay() {
        ArchRule rule = layeredArchitecture()
                .consideringOnlyDependenciesInLayers()
                .withOptionalLayers(true)
                .layer("doors")
                .definedBy("org.memtrack.ui..", "org.memtrack.macro..")
                .layer("run")
                .definedBy("org.memtrack.run..")
                .layer("outside")
                .definedBy(
                        "org.memtrack.trackmate..",
                        "org.memtrack.formats..",
                        "org.memtrack.client..",
                        "org.memtrack.server..")
                .layer("science")
                .definedBy("org.memtrack.tracking..", "org.memtrack.motility..", "org.memtrack.video..")
                .layer("detection")
                .definedBy("org.memtrack.detection..")
                .whereLayer("doors")
                .mayNotBeAccessedByAnyLayer()
                .whereLayer("run")
                .mayOnlyBeAccessedByLayers("doors")
                .whereLayer("outside")
                .mayOnlyBeAccessedByLayers("doors", "run")
                .whereLayer("science")
                .mayOnlyBeAccessedByLayers("doors", "run", "outside");

        rule.check(CLASSES);
    }

    @Test
    void packagesHaveNoCycles() {
        slices().matching("org.memtrack.(*)..").should().beFreeOfCycles().check(CLASSES);
    }

    @Test
    void trackerAndMotilityNeedNoImageJ() {
        ArchRuleDefinition.noClasses()
                .that()
                .resideInAnyPackage(
                        "org.memtrack.detection..",
                        "org.memtrack.tracking..",
                        "org.memtrack.motility..",
                        "org.memtrack.formats..")
                .should()
                .dependOnClassesThat()
                .resideInAnyPackage("ij..", "fiji..", "net.imglib2..", "org.scijava..", "io.grpc..")
                .check(CLASSES);
    }

    @Test
    void everyPackageIsNullMarked() {
        Set<String> unmarked = CLASSES.stream()
                .map(JavaClass::getPackage)
                .filter(javaPackage -> !javaPackage.isAnnotatedWith(NullMarked.class))
                .map(javaPackage -> javaPackage.getName())
                .collect(Collectors.toSet());

        assertThat(CLASSES).hasSizeGreaterThan(30);
        assertThat(unmarked).isEmpty();
    }
}
