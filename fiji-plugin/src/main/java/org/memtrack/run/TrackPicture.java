// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Font;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.geom.Ellipse2D;
import java.awt.geom.Line2D;
import java.awt.geom.Rectangle2D;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import javax.imageio.ImageIO;
import org.memtrack.detection.Box;
import org.memtrack.formats.AtomicFiles;
import org.memtrack.formats.TrackedFilm;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.Film;

/**
 * The last frame of a film with its tracks: paths of all tracks, a box around what is there in the last frame; the paths of
 * interpolated points are dotted and their boxes dashed.
 */
public final class TrackPicture {
    /** Small films are enlarged, so that lines do not hide the bacteria. */
    private static final int WANTED_WIDTH = 1000;

    private static final int CAPTION = 28;

    private final BufferedImage image;

    private TrackPicture(BufferedImage image) {
        this.image = image;
    }

    /** Draws the picture; reads the last frame of the film. */
    public static TrackPicture of(Film film, TrackedFilm tracked) {
        int width = film.info().width();
        int height = film.info().height();
        int scale = (WANTED_WIDTH + width - 1) / width;
        BufferedImage image = new BufferedImage(width * scale, height * scale + CAPTION, BufferedImage.TYPE_INT_RGB);
        Graphics2D graphics = image.createGraphics();
        int lastFrame = film.info().frameCount() - 1;
        graphics.drawImage(GreyFrame.of(film, lastFrame), 0, 0, width * scale, height * scale, null);
        graphics.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
        graphics.setClip(0, 0, width * scale, height * scale);
        for (Track track : tracked.tracks()) {
            graphics.setColor(colour(track.id()));
            drawPath(graphics, track, scale);
            track.points().stream()
                    .filter(point -> point.frame() == film.firstFrame() + lastFrame)
                    .forEach(point -> drawBox(graphics, track.id(), point, scale));
        }
        graphics.setClip(null);
        caption(graphics, film, tracked, height * scale);
        graphics.dispose();
        return new TrackPicture(image);
    }

    /** Writes it as PNG, all or nothing. */
    public void write(Path target) throws IOException {
        AtomicFiles.write(target, out -> ImageIO.write(image, "png", out));
    }

    BufferedImage image() {
        return image;
    }

    /** Neighbouring numbers get colours that are easy to tell apart. */
    public static Color colour(int trackId) {
        return Color.getHSBColor((float) (trackId * 0.618034 % 1), 0.75f, 1f);
    }

    private static void drawPath(Graphics2D graphics, Track track, int scale) {
        List<TrackPoint> points = track.points();
        for (int i = 1; i < points.size(); i++) {
            TrackPoint from = points.get(i - 1);
            TrackPoint to = points.get(i);
            if (to.interpolated()) {
                graphics.fill(new Ellipse2D.Double(x(to, scale) - 1.2, y(to, scale) - 1.2, 2.4, 2.4));
            } else if (!from.interpolated()) {
                graphics.setStroke(new BasicStroke(1.6f));
                graphics.draw(new Line2D.Double(x(from, scale), y(from, scale), x(to, scale), y(to, scale)));
            }
        }
    }

    private static void drawBox(Graphics2D graphics, int trackId, TrackPoint point, int scale) {
        Box box = point.box();
        graphics.setStroke(
                point.interpolated()
                        ? new BasicStroke(1.4f, BasicStroke.CAP_BUTT, BasicStroke.JOIN_MITER, 1, new float[] {4, 3}, 0)
                        : new BasicStroke(1.4f));
        // The centre of pixel (0, 0) is at (0, 0); its corner is half a pixel up and left.
        graphics.draw(new Rectangle2D.Double(
                (box.xMin() + 0.5) * scale, (box.yMin() + 0.5) * scale, box.width() * scale, box.height() * scale));
        graphics.setFont(new Font(Font.SANS_SERIF, Font.PLAIN, 12));
        graphics.drawString(
                Integer.toString(trackId), (float) (box.xMax() + 1) * scale, (float) (box.yMin() + 1) * scale);
    }

    private static void caption(Graphics2D graphics, Film film, TrackedFilm tracked, int top) {
        graphics.setRenderingHint(RenderingHints.KEY_TEXT_ANTIALIASING, RenderingHints.VALUE_TEXT_ANTIALIAS_ON);
        graphics.setColor(Color.WHITE);
        graphics.setFont(new Font(Font.SANS_SERIF, Font.PLAIN, 14));
        String text = "%s, frame %d: %d tracks; dotted and dashed: interpolated"
                .formatted(
                        film.info().title(),
                        film.firstFrame() + film.info().frameCount(),
                        tracked.tracks().size());
        graphics.drawString(text, 8, top + CAPTION - 9);
    }

    private static double x(TrackPoint point, int scale) {
        return (point.box().centreX() + 0.5) * scale;
    }

    private static double y(TrackPoint point, int scale) {
        return (point.box().centreY() + 0.5) * scale;
    }
}
