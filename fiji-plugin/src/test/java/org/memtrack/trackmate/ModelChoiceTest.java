// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;
import org.memtrack.client.ModelCard;

class ModelChoiceTest {
    private static final ModelCard OTHER = new ModelCard("other", "2", "Finds other things.", "ab12");
    private static final ModelCard DEFAULT = new ModelCard("default", "5", "Finds bacteria.", "cd34");

    @Test
    void theCardIsWhatAUserCanUnderstand() {
        ModelChoice choice = new ModelChoice();
        choice.offer(List.of(OTHER, DEFAULT));
        assertThat(choice.card()).isEqualTo("default 5: Finds bacteria.");
        choice.select("other", "2");
        assertThat(choice.card()).isEqualTo("Finds other things.");
    }

    @Test
    void noOtherModelStandsForADefaultThatTheServerLacks() {
        ModelChoice choice = new ModelChoice();
        choice.offer(List.of(OTHER));
        assertThat(choice.name()).isEmpty();
        assertThat(choice.card()).isEmpty();
    }

    @Test
    void aModelThatTheServerLacksStaysSelected() {
        ModelChoice choice = new ModelChoice();
        choice.select("mine", "3");
        choice.offer(List.of(DEFAULT));
        assertThat(choice.name()).isEqualTo("mine");
        assertThat(choice.version()).isEqualTo("3");
    }
}
