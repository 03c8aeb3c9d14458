// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.Arrays;

/**
 * The linear assignment problem, solved by shortest augmenting paths with dual prices (the Hungarian method as Jonker and
 * Volgenant, 1987, arrange it), in O(rows^2 columns).
 */
final class LinearAssignment {
    private static final int FREE = -1;

    private final double[][] cost;
    private final int columns;
    private final double[] rowPrice;
    private final double[] columnPrice;
    private final int[] rowOfColumn;

    private LinearAssignment(double[][] cost) {
        this.cost = cost;
        this.columns = cost[0].length;
        this.rowPrice = new double[cost.length];
        this.columnPrice = new double[columns];
        this.rowOfColumn = new int[columns];
        Arrays.fill(rowOfColumn, FREE);
    }

    /**
     * The column of each row, no column twice, at the least total cost.
     *
     * @param cost finite, rows x columns, at least as many columns as rows
     */
    static int[] solve(double[][] cost) {
        if (cost.length == 0) {
            return new int[0];
        }
        if (cost[0].length < cost.length) {
            throw new IllegalArgumentException(
                    "%d rows do not fit into %d columns".formatted(cost.length, cost[0].length));
        }
        LinearAssignment assignment = new LinearAssignment(cost);
        for (int row = 0; row < cost.length; row++) {
            assignment.augment(row);
        }
        int[] columnOfRow = new int[cost.length];
        for (int column = 0; column < assignment.columns; column++) {
            if (assignment.rowOfColumn[column] != FREE) {
                columnOfRow[assignment.rowOfColumn[column]] = column;
            }
        }
        return columnOfRow;
    }

    /** Gives the row a column, moving earlier rows to other columns along the cheapest path. */
    private void augment(int startRow) {
        double[] distance = new double[columns];
        Arrays.fill(distance, Double.POSITIVE_INFINITY);
        int[] cameFrom = new int[columns]; // the column whose row led here, FREE for the start row
        boolean[] settled = new boolean[columns];
        int row = startRow;
        int last = FREE;
        double reached = 0;
        while (true) {
            int nearest = FREE;
            for (int column = 0; column < columns; column++) {
                if (settled[column]) {
                    continue;
                }
                double through = reached + cost[row][column] - rowPrice[row] - columnPrice[column];
                if (through < distance[column]) {
                    distance[column] = through;
                    cameFrom[column] = last;
                }
                if (nearest == FREE || distance[column] < distance[nearest]) {
                    nearest = column;
                }
            }
            reached = distance[nearest];
            settled[nearest] = true;
            last = nearest;
            if (rowOfColumn[nearest] == FREE) {
                break;
            }
            row = rowOfColumn[nearest];
        }
        updatePrices(startRow, distance, settled, reached);
        for (int column = last; column != FREE; column = cameFrom[column]) {
            rowOfColumn[column] = cameFrom[column] == FREE ? startRow : rowOfColumn[cameFrom[column]];
        }
    }

    private void updatePrices(int startRow, double[] distance, boolean[] settled, double reached) {
        rowPrice[startRow] += reached;
        for (int column = 0; column < columns; column++) {
            if (settled[column] && rowOfColumn[column] != FREE) {
                rowPrice[rowOfColumn[column]] += reached - distance[column];
                columnPrice[column] -= reached - distance[column];
            }
        }
    }
}
