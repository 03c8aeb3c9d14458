// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import java.util.Arrays;
import java.util.Random;
import org.junit.jupiter.api.Test;

class LinearAssignmentTest {

    @Test
    void theGreedyChoiceIsGivenUpForABetterTotal() {
        double[][] cost = {{1, 2}, {1, 9}};

        assertThat(LinearAssignment.solve(cost)).containsExactly(1, 0);
    }

    @Test
    void noRowsNeedNoColumns() {
        assertThat(LinearAssignment.solve(new double[0][0])).isEmpty();
    }

    @Test
    void moreRowsThanColumnsAreRefused() {
        assertThatThrownBy(() -> LinearAssignment.solve(new double[3][2]))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("3 rows do not fit into 2 columns");
    }

    @Test
    void randomCostsAreSolvedAsWellAsByTryingAll() {
        Random random = new Random(7);
        for (int world = 0; world < 500; world++) {
            int rows = 1 + random.nextInt(5);
            int columns = rows + random.nextInt(3);
            boolean withTies = world % 2 == 0;
            double[][] cost = new double[rows][columns];
            for (double[] row : cost) {
                // Costs below zero are allowed.
                Arrays.setAll(row, i -> withTies ? random.nextInt(4) - 2 : random.nextGaussian());
            }

            int[] solution = LinearAssignment.solve(cost);

            assertThat(solution).doesNotHaveDuplicates();
            double total = 0;
            for (int row = 0; row < rows; row++) {
                total += cost[row][solution[row]];
            }
            assertThat(total).isCloseTo(leastTotal(cost, 0, new boolean[columns]), within(1e-9));
        }
    }

    private static double leastTotal(double[][] cost, int row, boolean[] taken) {
        if (row == cost.length) {
            return 0;
        }
        double least = Double.POSITIVE_INFINITY;
        for (int column = 0; column < taken.length; column++) {
            if (!taken[column]) {
                taken[column] = true;
                least = Math.min(least, cost[row][column] + leastTotal(cost, row + 1, taken));
                taken[column] = false;
            }
        }
        return least;
    }
}
