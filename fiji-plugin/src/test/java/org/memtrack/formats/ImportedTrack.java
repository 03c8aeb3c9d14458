// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.util.List;
import java.util.Optional;
import org.memtrack.motility.MotilityClass;

/**
 * A track as it stands in a file.
 *
 * @param id number in the file
 * @param name as in the file
 * @param spots in order of frame
 * @param linkCosts of each link from spot to spot, in order; none where the format has no links
 * @param motility class of motility that the file names
 */
record ImportedTrack(
        int id, String name, List<ImportedSpot> spots, List<Double> linkCosts, Optional<MotilityClass> motility) {}
