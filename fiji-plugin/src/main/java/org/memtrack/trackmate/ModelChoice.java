// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import java.awt.event.ActionListener;
import java.util.ArrayList;
import java.util.List;
import javax.swing.DefaultComboBoxModel;
import javax.swing.JComboBox;
import org.memtrack.client.ModelCard;

/** Chooses among the server's models; before they are known, what the settings say can be kept. */
final class ModelChoice {
    /** Version "" is the newest, name "" the model called default. */
    private record Item(String name, String version, String description) {
        boolean same(Item other) {
            return name.equals(other.name) && version.equals(other.version);
        }

        @Override
        public String toString() {
            return name.isEmpty() ? "default model" : version.isEmpty() ? name + " (newest)" : name + " " + version;
        }
    }

    private static final Item DEFAULT = new Item("", "", "");

    private final JComboBox<Item> box = new JComboBox<>(new Item[] {DEFAULT});

    JComboBox<?> box() {
        return box;
    }

    void onChange(ActionListener listener) {
        box.addActionListener(listener);
    }

    String name() {
        return selected().name;
    }

    String version() {
        return selected().version;
    }

    /** What the selected model is, for the user; empty before the server's models are known. */
    String card() {
        return selected().description;
    }

    /** Selects a model, whether the server has it or not. */
    void select(String name, String version) {
        Item wanted = new Item(name, version, "Not known to the server yet.");
        for (int i = 0; i < box.getItemCount(); i++) {
            if (box.getItemAt(i).same(wanted)) {
                box.setSelectedIndex(i);
                return;
            }
        }
        box.addItem(wanted);
        box.setSelectedItem(wanted);
    }

    /**
     * Offers these models and keeps the selection.
     *
     * @param cards those of one name newest first, as the server tells them
     */
    void offer(List<ModelCard> cards) {
        Item selected = selected();
        List<Item> items = new ArrayList<>();
        items.add(cards.stream()
                .filter(card -> card.name().equals("default"))
                .findFirst()
                .map(card -> new Item("", "", "%s %s: %s".formatted(card.name(), card.version(), card.description())))
                .orElse(DEFAULT));
        for (ModelCard card : cards) {
            items.add(new Item(card.name(), card.version(), card.description()));
        }
        box.setModel(new DefaultComboBoxModel<>(items.toArray(Item[]::new)));
        select(selected.name, selected.version);
    }

    private Item selected() {
        return box.getItemAt(Math.max(0, box.getSelectedIndex()));
    }
}
