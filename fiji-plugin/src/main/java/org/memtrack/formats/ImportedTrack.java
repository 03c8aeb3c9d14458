// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import org.memtrack.motility.MotilityClass;

/**
 * A track as it stands in a file: it may have gaps, splits and merges.
 *
 * @param id number in the file, or given by the reader, unique within the file
 * @param name as in the file
 * @param spots in order of frame
 * @param links from spot to spot
 * @param visible whether it passed the file's track filters
 * @param motility class of motility that the file names
 */
public record ImportedTrack(
        int id,
        String name,
        List<ImportedSpot> spots,
        List<Link> links,
        boolean visible,
        Optional<MotilityClass> motility) {
    public ImportedTrack {
        spots = List.copyOf(spots);
        links = List.copyOf(links);
    }

    /** A track without splits and merges: its spots, in any order, linked from frame to frame. */
    static ImportedTrack chain(int id, String name, List<ImportedSpot> spots) {
        List<ImportedSpot> sorted = spots.stream()
                .sorted(Comparator.comparingInt(ImportedSpot::frame))
                .toList();
        List<Link> links = new ArrayList<>();
        for (int i = 1; i < sorted.size(); i++) {
            links.add(new Link(sorted.get(i - 1).id(), sorted.get(i).id(), Double.NaN));
        }
        return new ImportedTrack(id, name, sorted, links, true, Optional.empty());
    }

    ImportedTrack withMotility(Optional<MotilityClass> motilityClass) {
        return new ImportedTrack(id, name, spots, links, visible, motilityClass);
    }

    /**
     * Two spots joined.
     *
     * @param sourceId number of the earlier spot
     * @param targetId number of the later spot
     * @param cost of the link; NaN when the file has none
     */
    public record Link(int sourceId, int targetId, double cost) {}
}
