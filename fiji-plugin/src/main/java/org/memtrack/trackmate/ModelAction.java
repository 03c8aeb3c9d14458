// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.SelectionModel;
import fiji.plugin.trackmate.TrackMate;
import fiji.plugin.trackmate.action.AbstractTMAction;
import fiji.plugin.trackmate.gui.displaysettings.DisplaySettings;
import java.awt.Frame;
import java.io.IOException;
import java.util.concurrent.CancellationException;
import org.memtrack.detection.DetectorException;

/** An action on the tracks of a model; it ends with one sentence in TrackMate's log, whatever happens. */
abstract class ModelAction extends AbstractTMAction {
    @Override
    public final void execute(TrackMate trackmate, SelectionModel selection, DisplaySettings display, Frame parent) {
        try {
            ModelTracks tracks = ModelTracks.of(trackmate);
            tracks.notes().forEach(note -> logger.log("Note: %s%n".formatted(note)));
            act(tracks);
        } catch (CancellationException e) {
            logger.log("Cancelled.\n");
        } catch (DetectorException | IOException e) {
            logger.error(e.getMessage() + "\n");
        }
    }

    /**
     * Does the work, asking the user for what it needs.
     *
     * @throws CancellationException when the user does not answer
     */
    abstract void act(ModelTracks tracks) throws IOException;

    /** Says something in TrackMate's log. */
    final void say(String sentence) {
        logger.log(sentence + "\n");
    }
}
