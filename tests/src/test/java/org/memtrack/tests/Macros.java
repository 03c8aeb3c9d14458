// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

/** Runs its arguments as macros, one after the other, in one headless ImageJ; ends with 1 when one fails. */
public final class Macros {
    private Macros() {}

    public static void main(String[] macros) throws Exception {
        MacroSession session = new MacroSession();
        for (String macro : macros) {
            String result = session.run(macro, "");
            System.out.println(result);
            if (result.equals("[aborted]")) {
                System.exit(1);
            }
        }
        System.exit(0);
    }
}
