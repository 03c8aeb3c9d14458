// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import java.awt.BorderLayout;
import java.awt.Font;
import java.awt.GridBagConstraints;
import java.awt.GridBagLayout;
import java.awt.Insets;
import javax.swing.BorderFactory;
import javax.swing.JComponent;
import javax.swing.JLabel;
import javax.swing.JPanel;
import javax.swing.JSpinner;
import javax.swing.SpinnerNumberModel;

/** Lays out rows of a label and a widget, as narrow as TrackMate's wizard. */
final class Form {
    private static final int TOOLTIP_WIDTH = 300;
    private static final int WIZARD_WIDTH = 225;
    private static final float TEXT_SIZE = 11;

    private final JPanel panel;
    private int row;

    Form(JPanel panel) {
        this.panel = panel;
        panel.setLayout(new GridBagLayout());
        panel.setBorder(BorderFactory.createEmptyBorder(8, 8, 8, 8));
    }

    /** A heading and, below it, what this is about. */
    void title(String heading, String text) {
        JLabel title = new JLabel(heading);
        note(title);
        title.setFont(title.getFont().deriveFont(Font.BOLD, 14f));
        sentence(text);
    }

    /** A widget with its label; both show the tooltip. */
    void row(String label, JComponent widget, String tooltip) {
        JLabel name = new JLabel(label);
        name.setLabelFor(widget);
        name.setFont(plain(name.getFont()));
        widget.setFont(plain(widget.getFont()));
        name.setToolTipText(wrapped(tooltip, TOOLTIP_WIDTH));
        widget.setToolTipText(wrapped(tooltip, TOOLTIP_WIDTH));
        panel.add(name, at(0, 1, 0));
        panel.add(widget, at(1, 1, 1));
        row++;
    }

    /** Something as wide as the form. */
    void note(JComponent wide) {
        wide.setFont(plain(wide.getFont()));
        panel.add(wide, at(0, 2, 1));
        row++;
    }

    /** Two widgets side by side, together as wide as the form. */
    void beside(JComponent first, JComponent second) {
        JPanel both = new JPanel(new BorderLayout());
        both.add(first, BorderLayout.WEST);
        both.add(second, BorderLayout.CENTER);
        first.setFont(plain(first.getFont()));
        second.setFont(plain(second.getFont()));
        note(both);
    }

    /** A sentence as wide as the form. */
    void sentence(String text) {
        note(new JLabel(wrapped(text, WIZARD_WIDTH)));
    }

    /** Pushes the rows to the top. */
    void fill() {
        GridBagConstraints rest = at(0, 2, 1);
        rest.weighty = 1;
        panel.add(new JLabel(), rest);
    }

    private static Font plain(Font font) {
        return font.deriveFont(Font.PLAIN, TEXT_SIZE);
    }

    static JSpinner whole(int value, int least, int greatest) {
        return new JSpinner(new SpinnerNumberModel(value, least, greatest, 1));
    }

    static JSpinner number(double value, double least, double greatest, double step) {
        return new JSpinner(new SpinnerNumberModel(value, least, greatest, step));
    }

    static String wrapped(String text, int width) {
        return "<html><body style='width:%dpx'>%s</body></html>".formatted(width, text);
    }

    private GridBagConstraints at(int column, int width, double weight) {
        GridBagConstraints constraints = new GridBagConstraints();
        constraints.gridx = column;
        constraints.gridy = row;
        constraints.gridwidth = width;
        constraints.weightx = weight;
        constraints.fill = GridBagConstraints.HORIZONTAL;
        constraints.anchor = GridBagConstraints.NORTHWEST;
        constraints.insets = new Insets(2, 3, 2, 3);
        return constraints;
    }
}
