// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.geom.Ellipse2D;
import java.awt.geom.Path2D;
import java.awt.image.BufferedImage;
import javax.swing.ImageIcon;

/** A swimmer at the end of its track, drawn rather than shipped. */
final class MemtrackIcon {
    /** As large as TrackMate's icons of detectors and trackers. */
    static final ImageIcon LARGE = draw(64);

    /** As large as TrackMate's icons of actions. */
    static final ImageIcon SMALL = draw(16);

    private MemtrackIcon() {}

    private static ImageIcon draw(int size) {
        BufferedImage image = new BufferedImage(size, size, BufferedImage.TYPE_INT_ARGB);
        Graphics2D graphics = image.createGraphics();
        graphics.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
        graphics.scale(size / 64.0, size / 64.0);
        Path2D track = new Path2D.Double();
        track.moveTo(4, 46);
        track.curveTo(14, 24, 22, 52, 32, 36);
        graphics.setColor(new Color(70, 130, 180));
        graphics.setStroke(new BasicStroke(4, BasicStroke.CAP_ROUND, BasicStroke.JOIN_ROUND));
        graphics.draw(track);
        graphics.rotate(Math.toRadians(-35), 46, 28);
        graphics.setColor(new Color(200, 90, 40));
        graphics.fill(new Ellipse2D.Double(32, 21, 28, 14));
        graphics.dispose();
        return new ImageIcon(image);
    }
}
