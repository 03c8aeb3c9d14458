// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.util.List;

/**
 * A track as it stands in a file: it may have gaps, splits and merges.
 *
 * @param id number in the file, or given by the reader, unique within the file
 * @param name as in the file
 * @param spots in order of frame
 * @param links from spot to spot
 * @param visible whether it passed the file's track filters
 */
public record ImportedTrack(int id, String name, List<ImportedSpot> spots, List<Link> links, boolean visible) {
    public ImportedTrack {
        spots = List.copyOf(spots);
        links = List.copyOf(links);
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
