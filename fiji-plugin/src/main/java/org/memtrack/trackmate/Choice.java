// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import java.util.Arrays;
import java.util.Locale;
import java.util.Vector;
import javax.swing.ComboBoxModel;
import javax.swing.JComboBox;
import org.memtrack.tracking.Association;
import org.memtrack.tracking.Interpolation;
import org.memtrack.trackmate.DetectorSettings.ThresholdSource;

/**
 * One of the values of a setting, in a combo box.
 *
 * @param value as it stands in the settings, by its name
 * @param label as the user reads it
 */
record Choice<E extends Enum<E>>(E value, String label) {
    static final Vector<Choice<Association>> ASSOCIATIONS = new Vector<>(Arrays.asList(
            new Choice<>(Association.MOTION, "by how swimmers move"),
            new Choice<>(Association.OVERLAP, "by overlap (SORT)")));
    static final Vector<Choice<Interpolation>> INTERPOLATIONS = new Vector<>(Arrays.asList(
            new Choice<>(Interpolation.FILL_GAPS, "fill the gaps"),
            new Choice<>(Interpolation.AUTHORS, "go on by prediction")));
    static final Vector<Choice<ThresholdSource>> THRESHOLD_SOURCES = new Vector<>(Arrays.asList(
            new Choice<>(ThresholdSource.MAXIMUM_PRECISION, "maximum precision"),
            new Choice<>(ThresholdSource.MAXIMUM_F1, "maximum F1"),
            new Choice<>(ThresholdSource.GIVEN, "given below")));

    @Override
    public String toString() {
        return label;
    }

    /** Selects the choice that a setting names; leaves the box as it is when there is none such. */
    static <E extends Enum<E>> void select(JComboBox<Choice<E>> box, Object name) {
        ComboBoxModel<Choice<E>> model = box.getModel();
        for (int i = 0; i < model.getSize(); i++) {
            if (model.getElementAt(i).value.name().equals(String.valueOf(name).toUpperCase(Locale.ROOT))) {
                box.setSelectedIndex(i);
            }
        }
    }

    /** The setting's value for the selected choice. */
    static <E extends Enum<E>> String selected(JComboBox<Choice<E>> box) {
        return box.getItemAt(box.getSelectedIndex()).value.name();
    }
}
