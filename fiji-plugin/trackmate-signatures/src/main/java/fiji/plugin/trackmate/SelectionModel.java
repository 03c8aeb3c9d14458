// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

public class SelectionModel {
    SelectionModel() {}
}
