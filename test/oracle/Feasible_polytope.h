// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <gmpxx.h>
#include <numeric>
#include <utility>

namespace haptic_sculpt::test {

/// The polyhedron { x >= 0 : M x = b } for a 5 x 5 integer matrix M of any rank, and its vertices.
///
/// A vertex is a basic feasible solution: choose a maximal independent set of columns, let the other variables vanish,
/// solve, and keep the solution if nothing in it is negative. All column sets are tried, so every vertex is found,
/// whatever the rank; there is no special case. The elimination is Bareiss' fraction-free one, carried above the
/// diagonal too: every intermediate number is a minor of (M | b) and every division is exact.
class Feasible_polytope {
public:
  static constexpr int size = 5;
  static constexpr int right_hand_side = size;
  using Row = std::array<mpz_class, size + 1>;

  /// Row r of (M | b), to be filled before visit_vertices().
  Row& row(int r) { return m_rows[r]; }

  /// Calls `visit(x, denominator)` for every vertex x / denominator, `denominator` > 0; a degenerate vertex may come
  /// more than once. Calls nothing if the polyhedron is empty.
  template <class Visitor> void visit_vertices(Visitor&& visit) {
    std::array<int, size> all;
    std::iota(all.begin(), all.end(), 0);
    const int rank = eliminate(all.data(), size);
    for (int r = rank; r < size; ++r)
      if (sgn(m_work[m_order[r]][right_hand_side]) != 0)
        return; // M x = b has no solution of any sign
    if (rank == size) {
      report(rank, visit);
      return;
    }
    for (unsigned subset = 0; subset < (1u << size); ++subset) {
      std::array<int, size> columns;
      int count = 0;
      for (int c = 0; c < size; ++c)
        if (subset >> c & 1u)
          columns[count++] = c;
      if (count == rank && eliminate(columns.data(), count) == rank)
        report(rank, visit);
    }
  }

private:
  /// Reduces the given columns to a diagonal; returns their rank. Row m_order[k] then reads
  /// m_pivot * x[m_basis[k]] = right-hand side, once all variables outside the basis are zero.
  int eliminate(const int* columns, int count) {
    for (int r = 0; r < size; ++r) {
      m_order[r] = r;
      for (int k = 0; k < count; ++k)
        m_work[r][columns[k]] = m_rows[r][columns[k]];
      m_work[r][right_hand_side] = m_rows[r][right_hand_side];
    }
    m_pivot = 1;
    int rank = 0;
    for (int k = 0; k < count; ++k) {
      const int column = columns[k];
      int found = rank;
      while (found < size && sgn(m_work[m_order[found]][column]) == 0)
        ++found;
      if (found == size)
        continue;
      std::swap(m_order[rank], m_order[found]);
      const Row& pivot_row = m_work[m_order[rank]];
      const mpz_class& pivot = pivot_row[column];
      for (int r = 0; r < size; ++r) {
        Row& row = m_work[r];
        if (&row == &pivot_row)
          continue;
        for (int next = k + 1; next <= count; ++next) {
          const int c = next == count ? right_hand_side : columns[next];
          mpz_mul(row[c].get_mpz_t(), row[c].get_mpz_t(), pivot.get_mpz_t());
          mpz_submul(row[c].get_mpz_t(), row[column].get_mpz_t(), pivot_row[c].get_mpz_t());
          mpz_divexact(row[c].get_mpz_t(), row[c].get_mpz_t(), m_pivot.get_mpz_t());
        }
      }
      m_pivot = pivot;
      m_basis[rank++] = column;
    }
    return rank;
  }

  template <class Visitor> void report(int rank, Visitor&& visit) {
    const int sign = sgn(m_pivot);
    for (int k = 0; k < rank; ++k)
      if (sgn(m_work[m_order[k]][right_hand_side]) * sign < 0)
        return;
    for (mpz_class& x : m_vertex)
      x = 0;
    for (int k = 0; k < rank; ++k)
      mpz_abs(m_vertex[m_basis[k]].get_mpz_t(), m_work[m_order[k]][right_hand_side].get_mpz_t());
    mpz_abs(m_pivot.get_mpz_t(), m_pivot.get_mpz_t());
    visit(std::as_const(m_vertex), std::as_const(m_pivot));
  }

  std::array<Row, size> m_rows, m_work;
  std::array<mpz_class, size> m_vertex;
  mpz_class m_pivot;
  std::array<int, size> m_order{}, m_basis{};
};

} // namespace haptic_sculpt::test
