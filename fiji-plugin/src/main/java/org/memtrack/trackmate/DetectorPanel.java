// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.gui.components.ConfigurationPanel;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import javax.swing.JButton;
import javax.swing.JCheckBox;
import javax.swing.JComboBox;
import javax.swing.JLabel;
import javax.swing.JSpinner;
import org.jspecify.annotations.Nullable;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.ModelCard;

/** The detector's settings in TrackMate's wizard, with the model's card, the server's state and a preview. */
final class DetectorPanel extends ConfigurationPanel {
    private static final long serialVersionUID = 1;
    private static final int TEXT_WIDTH = 220;

    private final transient ModelChoice model = new ModelChoice();
    private final JLabel card = new JLabel();
    private final JLabel server = new JLabel();
    private final JButton again = new JButton("Check again");
    private final JComboBox<Choice<DetectorSettings.ThresholdSource>> thresholds =
            new JComboBox<>(Choice.THRESHOLD_SOURCES);
    private final JSpinner low = Form.number(0.5, 0, 1, 0.05);
    private final JSpinner medium = Form.number(0.5, 0, 1, 0.05);
    private final JSpinner high = Form.number(0.5, 0, 1, 0.05);
    private final JSpinner channel;
    private final JSpinner cellLength = Form.number(0, 0, DetectionSettings.GREATEST_CELL_LENGTH_PX, 1);
    private final JSpinner maximumSize = Form.number(0, 0, 10_000, 1);
    private final JSpinner nmsIou = Form.number(0, 0, 1, 0.05);
    private final JCheckBox stabilise = new JCheckBox("Undo drift of the stage", true);
    private final JCheckBox resting = new JCheckBox("Resting cells, too");
    private final JButton previewButton = new JButton("Preview");
    private final JLabel previewState = new JLabel();
    private final transient DetectorPreview preview;
    private transient @Nullable ModelsOfServer question;

    DetectorPanel(Settings settings, Model trackmateModel) {
        int channels = settings.imp == null ? 1 : settings.imp.getNChannels();
        channel = Form.whole(1, 1, channels);
        preview = new DetectorPreview(settings, trackmateModel, previewButton, previewState);
        layOut();
        model.onChange(event -> showCard());
        thresholds.addActionListener(event -> enableThresholds());
        again.addActionListener(event -> askServer());
        previewButton.addActionListener(event -> preview.startOrCancel(getSettings()));
        setSettings(DetectorSettings.MAP.defaults());
        askServer();
    }

    private void layOut() {
        Form form = new Form(this);
        form.title(MemtrackDetectorFactory.NAME, "Finds bacteria and microrobots by how they move.");
        server.setToolTipText("The local Python that the network runs in; MEMTrack starts and ends it by itself.");
        form.note(server);
        form.row("", again, "Look for the server again, for example after Python was installed.");
        form.row("Model", model.box(), "The trained network to detect with.");
        form.note(card);
        form.row(
                "Thresholds for",
                thresholds,
                "Which score thresholds to use: maximum precision, at least 0.98 on the model's validation films; maximum"
                        + " F1, the lowest thresholds whose F1 there is within 0.003 of the best; or the three below.");
        form.row("  low motility", low, "Least score of a spot found by the level for slow motion, 0 to 1.");
        form.row("  medium motility", medium, "Least score of a spot found by the level for medium motion, 0 to 1.");
        form.row("  high motility", high, "Least score of a spot found by the level for fast motion, 0 to 1.");
        form.row("Channel", channel, "Channel of the image to detect in, counted from 1.");
        form.row(
                "Cell length (px)",
                cellLength,
                "Length of a cell as it looks in this film, 1 to 200 pixels; by it the film is brought to the model's scale. 0: by"
                        + " the film's pixel size, cells being taken to be 2 um long; without one the film is used as it is."
                        + " Much longer ones are recognised.");
        form.row(
                "Greatest size (px)",
                maximumSize,
                "Wider or taller boxes are dropped, in pixels at the model's scale. 0: 35, as in the paper.");
        form.row(
                "Greatest overlap (IoU)",
                nmsIou,
                "Of two boxes whose intersection over union exceeds this, the weaker is dropped, 0 to 1. 0: 0.7, as in"
                        + " the paper.");
        form.sentence("0 leaves a value to the film or to its default.");
        stabilise.setToolTipText(Form.wrapped(
                "Measure and undo the drift of the stage before the background is taken; spots are reported in the"
                        + " film as you see it.",
                TEXT_WIDTH));
        resting.setToolTipText(Form.wrapped(
                "Find cells that never move, too: what stays in its place and is as dark or as bright as the cells that"
                        + " move, some debris with it; where the medium is clear.",
                TEXT_WIDTH));
        form.beside(stabilise, resting);
        form.row(
                "",
                previewButton,
                "Show what is found in the current frame; %d frames to each side are looked at, too."
                        .formatted(DetectorPreview.REACH));
        form.note(previewState);
        form.fill();
    }

    private void askServer() {
        again.setVisible(false);
        question = new ModelsOfServer(this::showState, this::offer);
        question.execute();
    }

    /** In the width of the form, since what is wrong and what to do take a few lines. */
    void showState(String state) {
        server.setText(Form.wrapped("Server: " + LabelLogger.escaped(state), TEXT_WIDTH));
        again.setVisible(question != null && question.isDone() && !state.startsWith("Ready"));
    }

    private void offer(List<ModelCard> cards) {
        model.offer(cards);
        showCard();
    }

    private void showCard() {
        card.setText(Form.wrapped(LabelLogger.escaped(model.card()), TEXT_WIDTH));
        card.setVisible(!model.card().isEmpty());
    }

    private void enableThresholds() {
        boolean given = Choice.selected(thresholds).equals(DetectorSettings.ThresholdSource.GIVEN.name());
        low.setEnabled(given);
        medium.setEnabled(given);
        high.setEnabled(given);
    }

    @Override
    public void setSettings(Map<String, Object> settings) {
        model.select(
                (String) settings.get(DetectorSettings.MODEL), (String) settings.get(DetectorSettings.MODEL_VERSION));
        Choice.select(thresholds, settings.get(DetectorSettings.THRESHOLDS));
        low.setValue(settings.get(DetectorSettings.THRESHOLD_LOW));
        medium.setValue(settings.get(DetectorSettings.THRESHOLD_MEDIUM));
        high.setValue(settings.get(DetectorSettings.THRESHOLD_HIGH));
        channel.setValue(settings.get(DetectorSettings.CHANNEL));
        cellLength.setValue(settings.get(DetectorSettings.CELL_LENGTH));
        maximumSize.setValue(settings.get(DetectorSettings.MAXIMUM_SIZE));
        nmsIou.setValue(settings.get(DetectorSettings.NMS_IOU));
        stabilise.setSelected((Boolean) settings.get(DetectorSettings.STABILISE));
        resting.setSelected((Boolean) settings.get(DetectorSettings.RESTING));
        enableThresholds();
        showCard();
    }

    @Override
    public Map<String, Object> getSettings() {
        Map<String, Object> settings = new LinkedHashMap<>();
        settings.put(DetectorSettings.MODEL, model.name());
        settings.put(DetectorSettings.MODEL_VERSION, model.version());
        settings.put(DetectorSettings.THRESHOLDS, Choice.selected(thresholds));
        settings.put(DetectorSettings.THRESHOLD_LOW, number(low));
        settings.put(DetectorSettings.THRESHOLD_MEDIUM, number(medium));
        settings.put(DetectorSettings.THRESHOLD_HIGH, number(high));
        settings.put(DetectorSettings.CHANNEL, channel.getValue());
        settings.put(DetectorSettings.CELL_LENGTH, number(cellLength));
        settings.put(DetectorSettings.MAXIMUM_SIZE, number(maximumSize));
        settings.put(DetectorSettings.NMS_IOU, number(nmsIou));
        settings.put(DetectorSettings.STABILISE, stabilise.isSelected());
        settings.put(DetectorSettings.RESTING, resting.isSelected());
        return settings;
    }

    private static Double number(JSpinner spinner) {
        return ((Number) spinner.getValue()).doubleValue();
    }

    @Override
    public void clean() {
        preview.cancel();
        if (question != null) {
            question.cancel(false);
        }
    }
}
