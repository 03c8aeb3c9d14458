// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.api.Test;

class TrackMateInstallationTest {
    /** A Fiji in which only some types can be found. */
    private static ClassLoader with(String... types) {
        return new ClassLoader(null) {
            @Override
            protected Class<?> findClass(String name) throws ClassNotFoundException {
                for (String type : types) {
                    if (type.equals(name)) {
                        return Class.forName(name, false, TrackMateInstallationTest.class.getClassLoader());
                    }
                }
                throw new ClassNotFoundException(name);
            }
        };
    }

    @Test
    void withoutTrackMateTheUserReadsOneSentence() {
        assertThat(TrackMateInstallation.problem(with()))
                .hasValueSatisfying(sentence -> assertThat(sentence).startsWith("TrackMate is not installed"));
    }

    @Test
    void withAnOlderTrackMateTheUserReadsOneSentence() {
        assertThat(TrackMateInstallation.problem(with("fiji.plugin.trackmate.TrackMate")))
                .hasValueSatisfying(sentence -> assertThat(sentence).contains("older than 8.0.0", "Help > Update"));
    }

    @Test
    void withTrackMate8ThereIsNoProblem() {
        assertThat(TrackMateInstallation.problem(
                        with("fiji.plugin.trackmate.TrackMate", "fiji.plugin.trackmate.TrackMateFactoryBase")))
                .isEmpty();
        assertThat(TrackMateInstallation.problem()).isEmpty();
    }
}
