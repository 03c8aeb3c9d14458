// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.ImagePlus;
import ij.gui.GenericDialog;
import ij.gui.YesNoCancelDialog;
import java.awt.Checkbox;
import java.awt.Choice;
import java.awt.Color;
import java.awt.TextField;
import java.math.BigDecimal;
import java.math.MathContext;
import java.util.ArrayList;
import java.util.EnumSet;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.Set;
import java.util.Vector;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.TrackOption;
import org.memtrack.macro.TrackRequest;
import org.memtrack.video.ImageFilm;
import org.memtrack.video.Regions;

/** Asks for the options of "MEMTrack Track"; the last answers are offered again, in the dialog only. */
final class TrackDialog {
    /** Share a row with the option before, so that the page fits on a small laptop. */
    private static final Set<TrackOption> BESIDE = EnumSet.of(
            TrackOption.LAST_FRAME,
            TrackOption.THRESHOLD_MEDIUM,
            TrackOption.THRESHOLD_HIGH,
            TrackOption.NMS_IOU,
            TrackOption.MIN_HITS);

    private TrackDialog() {}

    /** What the user wants; empty when they cancel. Asked again while a value is wrong. */
    static Optional<TrackRequest> ask(ImagePlus image) {
        Map<TrackOption, String> values = RememberedOptions.of(image);
        Map<TrackOption, String> ofTheImage = ofTheImage(image);
        values.putAll(ofTheImage);
        values.put(TrackOption.CELL_LENGTH, text(Regions.lineLength(image)));
        if (!askForAxis(image, values)) {
            return Optional.empty();
        }
        String complaint = "";
        boolean more = RememberedOptions.changeWhatIsNotShown(values);
        while (true) {
            Optional<Boolean> answer = page(complaint, true, more, values);
            if (answer.isEmpty()) {
                return Optional.empty();
            }
            more = answer.get();
            if (more && page("", false, false, values).isEmpty()) {
                return Optional.empty();
            }
            try {
                TrackRequest request = TrackRequest.of(keyed(values, ofTheImage));
                RememberedOptions.keep(image, values);
                return Optional.of(request);
            } catch (DetectorException e) {
                complaint = e.getMessage();
            }
        }
    }

    private static boolean askForAxis(ImagePlus image, Map<TrackOption, String> values) {
        values.put(TrackOption.FRAMES, "t");
        if (!ImageFilm.framesLieOnZ(image)) {
            return true;
        }
        YesNoCancelDialog question = new YesNoCancelDialog(
                null,
                "MEMTrack",
                Commands.wrapped("\"%s\" has %d slices in Z and a single frame. Are the slices the frames of the film?"
                        .formatted(image.getTitle(), image.getNSlices())));
        if (question.cancelPressed()) {
            return false;
        }
        values.put(TrackOption.FRAMES, axis(image, question.yesPressed()));
        return true;
    }

    /**
     * The axis of an image whose slices lie on Z, as the user answered.
     *
     * @throws DetectorException when the slices are no frames: there is nothing that the other questions could mend
     */
    static String axis(ImagePlus image, boolean slicesAreFrames) {
        if (!slicesAreFrames) {
            throw new DetectorException(
                    "Then \"%s\" shows a single moment, in which nothing moves: open a film to track in."
                            .formatted(image.getTitle()));
        }
        return "z";
    }

    /**
     * One page of the dialog: empty when cancelled, otherwise whether the user asks for the other page.
     *
     * @param more whether that is ticked when the page opens
     */
    private static Optional<Boolean> page(
            String complaint, boolean common, boolean more, Map<TrackOption, String> values) {
        GenericDialog dialog = new GenericDialog(common ? "MEMTrack" : "MEMTrack: more options");
        if (!complaint.isEmpty()) {
            dialog.addMessage(Commands.wrapped(complaint), null, Color.RED);
        }
        List<TrackOption> shown = new ArrayList<>();
        if (!common) {
            dialog.addMessage("Help says what an empty field stands for.");
        } else {
            dialog.addMessage(Commands.wrapped(aboutScale(values)));
        }
        for (TrackOption option : TrackOption.values()) {
            if (option.common() == common) {
                add(dialog, option, values.getOrDefault(option, ""));
                shown.add(option);
            }
        }
        if (common) {
            boolean changed = RememberedOptions.changeWhatIsNotShown(values);
            dialog.addCheckbox(changed ? "More options (some are changed)..." : "More options...", more);
        }
        dialog.addHelp(help(shown));
        dialog.showDialog();
        if (dialog.wasCanceled()) {
            return Optional.empty();
        }
        return Optional.of(read(dialog, shown, values) && common);
    }

    /** By what the film is brought to the model's scale. */
    static String aboutScale(Map<TrackOption, String> values) {
        boolean sizeKnown = !values.get(TrackOption.PIXEL_SIZE).isEmpty();
        return (sizeKnown
                        ? "Cells are taken to be 2 um long, unless you give the length of one; much longer ones are recognised."
                        : "The film does not say its pixel size: give it, and cells are taken to be 2 um long, or give the length"
                                + " of a cell. With neither the film is used as it is. Much longer cells are recognised.")
                + " A straight line drawn along a cell before this command fills in its length.";
    }

    private static String help(List<TrackOption> shown) {
        StringBuilder page = new StringBuilder("<html><table width=600>");
        shown.forEach(option -> page.append("<tr><td valign=top width=180><b>%s</b></td><td>%s</td></tr>"
                .formatted(option.label(), option.help())));
        return page.append("</table></html>").toString();
    }

    private static void add(GenericDialog dialog, TrackOption option, String value) {
        if (BESIDE.contains(option)) {
            dialog.addToSameRow();
        }
        switch (option.kind()) {
            case FOLDER -> dialog.addDirectoryField(option.label(), value, 28);
            case TEXT, NUMBER, INTEGER ->
                dialog.addStringField(option.label(), value, option.kind() == TrackOption.Kind.TEXT ? 20 : 8);
            case CHOICE -> dialog.addChoice(option.label(), option.choices().toArray(String[]::new), value);
            case SWITCH -> dialog.addCheckbox(option.label(), value.equals("true"));
        }
    }

    /**
     * Reads the fields themselves: GenericDialog's own getters would record every value under its label. Gives the state of
     * the last checkbox.
     */
    @SuppressWarnings("unchecked")
    private static boolean read(GenericDialog dialog, List<TrackOption> shown, Map<TrackOption, String> values) {
        Iterator<TextField> texts = iterator(dialog.getStringFields());
        Iterator<Choice> choices = iterator(dialog.getChoices());
        Iterator<Checkbox> switches = iterator(dialog.getCheckboxes());
        for (TrackOption option : shown) {
            values.put(
                    option,
                    switch (option.kind()) {
                        case FOLDER, TEXT, NUMBER, INTEGER ->
                            texts.next().getText().strip();
                        case CHOICE -> choices.next().getSelectedItem();
                        case SWITCH -> Boolean.toString(switches.next().getState());
                    });
        }
        return switches.hasNext() && switches.next().getState();
    }

    private static <T> Iterator<T> iterator(Vector<T> fields) {
        return fields == null ? new Vector<T>().iterator() : fields.iterator();
    }

    /** What the image says itself, shown to the user, who may know better. */
    static Map<TrackOption, String> ofTheImage(ImagePlus image) {
        return Map.of(
                TrackOption.PIXEL_SIZE, text(ImageFilm.pixelSizeMicrometres(image)),
                TrackOption.FRAME_INTERVAL, text(ImageFilm.frameIntervalSeconds(image)));
    }

    /** What the user has chosen, by key; a recorded macro says of other films only that. */
    static Map<String, String> keyed(Map<TrackOption, String> values, Map<TrackOption, String> ofTheImage) {
        Map<String, String> keyed = new LinkedHashMap<>();
        values.forEach((option, value) -> {
            // An emptied field means the default.
            if (!value.isEmpty() && !value.equals(ofTheImage.get(option))) {
                keyed.put(option.key(), value);
            }
        });
        return keyed;
    }

    private static String text(OptionalDouble value) {
        return value.isEmpty()
                ? ""
                : BigDecimal.valueOf(value.getAsDouble())
                        .round(new MathContext(6))
                        .stripTrailingZeros()
                        .toPlainString();
    }
}
