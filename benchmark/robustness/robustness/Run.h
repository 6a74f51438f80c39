// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Benchmark_program.h"
#include "Compared_batches.h"
#include "Extreme_batch.h"
#include "broad_phases.h"

#include <haptic_sculpt/sculpting/paper_1997.h>
#include <haptic_sculpt/surface.h>
#include <haptic_sculpt/surface/repair.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>

namespace haptic_sculpt::robustness {

enum Exit {
  not_embedded = 10,     ///< validate() found a fault after drags or edits
  lazy_short = 11,       ///< fewer than 95 % of the short random drags arrived
  lazy_long = 12,        ///< a push through the object stayed at its start though it had more than two clearances to go
  wrongly_accepted = 13, ///< a mesh that has to be refused was not
  wrongly_refused = 14,  ///< a mesh that has to be accepted was refused
  mesh_changed = 15,     ///< a vertex that was not in hand has moved
  undo_differs = 16,     ///< undoing everything did not give back the input, bit for bit
  redo_differs = 17,     ///< redoing everything did not give back the end, bit for bit
  lazy_creation = 18,    ///< more than 1 % of the feasible creations were refused
  jumped_over = 19,      ///< a creation was accepted that crosses or jumps over a part of the surface
  not_finite = 20,       ///< an extreme drag left a coordinate that is no finite number
  went_away = 21,        ///< an extreme drag ended farther from its target than it began
  contradiction = 23,    ///< a result contradicts itself
  other_bits = 24,       ///< another broad phase has led to other results, if only in the last bit
  moved_though_refused = 22 ///< an extreme drag was refused with an error, and something had moved
};

struct Options {
  std::string folder, dump, response = "slide", motion = "odd";
  std::size_t drags = 10000, drags_on_large = 1000, edits = 5000, edits_on_large = 100, extreme = 0, batch = 1000,
              edit_batch = 5000, least_faces = 0;
  std::uint64_t seed = 1;
  std::vector<std::string> refuse, broad_phases = {"box_tree"};
  std::vector<double> clearances = {0}; ///< shares of the extent of a mesh; 0: the default of the library
  bool has_hard_meshes = false, repairs = false, dumps_all = false;
};

/// Faces and valence: from here on drags_on_large and edits_on_large, and one validation a batch.
constexpr std::size_t large = 200000, large_valence = 4000;

inline bool is_large(const Mesh& mesh) {
  std::vector<std::size_t> valence(mesh.num_vertices());
  for (const auto h : mesh.halfedges())
    ++valence[mesh.target(h)];
  return mesh.number_of_faces() >= large || *std::max_element(valence.begin(), valence.end()) >= large_valence;
}

/// All batches on all meshes, or a shard of them; sums them up.
class Run {
public:
  Run(const Options& options, const benchmark::Shard& shard)
      : options_(options)
      , shard_(shard)
      , response_(*response_named(options.response, {Response::paper()}))
      , batches_(broad_phases_named(options.broad_phases), options.dump,
                 options.dumps_all ? Keep::all : Keep::what_fails) {}

  /// With each of the clearances. \param is_hard short drags may be held with reason: they are not counted among those
  /// that have to arrive
  void mesh(const std::string& name, const Mesh& mesh, bool is_hard = false) {
    if (mesh.number_of_faces() < options_.least_faces)
      return;
    for (const double share : options_.clearances) {
      is_held_with_reason_ = is_hard || share != 0; // a wide clearance holds as a hard mesh does
      clearance_.reset();
      Json row = {{"unit", shard_.next_unit()}, {"mesh", name}, {"faces", mesh.number_of_faces()}};
      if (share != 0) {
        clearance_ = share * largest_extent(mesh);
        row["clearance"] = text_of_clearance(share);
      }
      counts_ = {};
      const bool has_drags = drag(name, mesh, row), has_edits = edit(name, mesh, row);
      row["compared"] = counts_.compared, row["other_bits"] = counts_.other_bits;
      row["clearance_refused"] = counts_.clearance_refused;
      all_counts_ += counts_;
      if (has_drags || has_edits || counts_.clearance_refused > 0)
        rows_.push_back(row);
    }
  }

  /// Drags with extreme targets, clearances and deltas: a share of all that are asked for.
  void extreme(const std::string& name, const Mesh& mesh, double share) {
    Extreme_tally tally;
    const std::size_t unit = shard_.next_unit();
    const auto drags = static_cast<std::size_t>(std::ceil(share * static_cast<double>(options_.extreme)));
    for (std::size_t done = 0; done < drags; done += options_.batch)
      if (is_ours())
        tally += Extreme_batch(mesh, response_, seed_of_batch()).run(std::min(options_.batch, drags - done));
    if (tally.drags + tally.refused == 0)
      return;
    extremes_ += tally;
    Json row = {{"unit", unit}, {"mesh", name}, {"faces", mesh.number_of_faces()}, {"extreme", tally.json()}};
    rows_.push_back(row);
    std::cout << name << ": extreme: " << tally.json().dump() << '\n' << std::flush;
  }

  /// Files that cannot be read are listed as refused ones are: one of them is no reason to lose the others. Where
  /// `--refuse` says which have to be refused the others have to be accepted; else nobody but the validation that is
  /// tried knows which are embedded.
  void folder() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(options_.folder))
      if (mesh_file_format(entry.path()))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const std::string& name : options_.refuse)
      if (std::none_of(files.begin(), files.end(), [&](const auto& file) { return file.filename().string() == name; }))
        throw benchmark::Wrong_use("--refuse names '" + name + "', which is no mesh of the folder");
    for (const auto& file : files) {
      const std::string name = file.filename().string();
      const bool has_to_be_refused =
          std::find(options_.refuse.begin(), options_.refuse.end(), name) != options_.refuse.end();
      ++files_read_;
      const std::string reason = work_on(name, file);
      wrongly_accepted_ += has_to_be_refused && reason.empty();
      if (reason.empty())
        continue;
      std::cout << name << ": refused: " << reason << '\n';
      const bool is_repaired = options_.repairs && repaired(name, file);
      wrongly_refused_ += !options_.refuse.empty() && !has_to_be_refused && !is_repaired;
      refused_.push_back(
          {{"file", name}, {"has_to_be", has_to_be_refused}, {"repaired", is_repaired}, {"reason", reason}});
    }
  }

  Json finish(benchmark::Promises& promises) const {
    add_promises(promises);
    std::cout << "in all " << drags_.drags << " drags and " << edits_.edits << " mixed edits, "
              << extremes_.drags + extremes_.refused << " extreme drags, response " << options_.response << ", motion "
              << options_.motion << ", " << all_counts_.compared << " batches compared, " << all_counts_.other_bits
              << " with other bits, seed " << options_.seed << ", exit " << promises.exit() << '\n';
    for (const auto& [kind, counts] : edits_.rows) {
      std::cout << "  " << kind << ": " << counts.asked << " asked, " << counts.done << " done";
      for (const auto& [reason, count] : counts.refused)
        std::cout << ", " << count << ' ' << reason;
      std::cout << '\n';
    }
    return {{"seed", options_.seed},
            {"response", options_.response},
            {"motion", options_.motion},
            {"broad_phases", joined(options_.broad_phases)},
            {"clearances", joined(texts_of_clearances())},
            {"meshes", rows_},
            {"total", drags_.json()},
            {"total_of_edits", edits_.json()},
            {"total_of_extreme_drags", extremes_.json()},
            {"wrongly_accepted", shard_.is_first() ? wrongly_accepted_ : 0}, // once, for all shares
            {"wrongly_refused", shard_.is_first() ? wrongly_refused_ : 0},
            {"refused", refused_}};
  }

private:
  /// \return why the file is refused; nothing where it is worked on
  std::string work_on(const std::string& name, const std::filesystem::path& file) {
    std::optional<Mesh> read;
    try {
      read = read_surface<Mesh>(file);
    } catch (const Error& error) {
      return error.what();
    }
    mesh(name, *read); // out of the try: an error of a drag is no fault of the file
    return {};
  }

  /// Works on what repair() makes of a refused file. \return whether that is a mesh
  bool repaired(const std::string& name, const std::filesystem::path& file) {
    Face_soup soup;
    try {
      soup = read_face_soup(file);
    } catch (const Error&) { // which is the reason that it was refused
      return false;
    }
    const Repair_report report = repair(soup);
    std::cout << name << ": " << report.message() << '\n';
    if (report.is_repaired())
      mesh(name + ", repaired", make_surface<Mesh>(soup), true);
    return report.is_repaired();
  }

  Options options_;
  benchmark::Shard shard_;
  Response response_;
  std::size_t files_read_ = 0, wrongly_accepted_ = 0, wrongly_refused_ = 0;
  Compared_batches batches_;
  Compared_batches::Counts counts_, all_counts_; ///< of the mesh at hand; of all
  bool is_held_with_reason_ = false; ///< of the mesh at hand
  std::optional<double> clearance_; ///< the same
  Drag_tally drags_;
  Edit_tally edits_;
  Extreme_tally extremes_;
  Json rows_ = Json::array(), refused_ = Json::array(); ///< what all shares refuse, with reasons

  /// Whether the next batch belongs to this shard.
  bool is_ours() { return shard_.takes_next(); }
  std::uint64_t seed_of_batch() const { return options_.seed * 1000003 + shard_.next_unit(); }

  static double largest_extent(const Mesh& mesh) {
    const CGAL::Bbox_3 box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
    return std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
  }

  static std::string text_of_clearance(double share) {
    std::ostringstream text;
    text << share << " of the extent";
    return share == 0 ? "default" : text.str();
  }
  std::vector<std::string> texts_of_clearances() const {
    std::vector<std::string> texts;
    for (const double share : options_.clearances)
      texts.push_back(text_of_clearance(share));
    return texts;
  }
  static std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
      text += (text.empty() ? "" : ", ") + word;
    return text;
  }

  template <class Tally>
  Tally made(const Mesh& mesh, std::size_t count, bool has_few, Batch_maker<Tally> Broad_phase_choice::*make) {
    const Batch batch{response_, clearance_, seed_of_batch(), count, std::size_t{has_few ? 0u : 100u},
                      options_.motion == "hand"};
    return batches_.make(mesh, batch, make, "batch_" + std::to_string(shard_.next_unit() - 1), counts_);
  }

  bool drag(const std::string& name, const Mesh& mesh, Json& row) {
    const bool has_few = is_large(mesh);
    const std::size_t drags = has_few ? options_.drags_on_large : options_.drags;
    Drag_tally tally;
    for (std::size_t done = 0; done < drags; done += options_.batch)
      if (is_ours())
        tally += made(mesh, std::min(options_.batch, drags - done), has_few, &Broad_phase_choice::drag_batch);
    if (tally.drags == 0)
      return false;
    row.update(tally.json());
    if (is_held_with_reason_)
      tally.short_asked = tally.short_arrived = 0;
    drags_ += tally;
    std::cout << name << ": " << tally.drags << " drags, " << tally.blocked << " blocked, short " << tally.short_arrived
              << '/' << tally.short_asked << ", through stayed " << tally.through_stayed << '/' << tally.through_asked
              << " (lazy " << tally.through_lazy << ", no contact " << tally.through_unexplained
              << "), stop error up to " << tally.largest_stop_error << " c, " << tally.invalid << " invalid of "
              << tally.validations << ", " << tally.nanoseconds / static_cast<double>(tally.drags) << " ns, at most "
              << tally.longest << " ns\n"
              << std::flush;
    return true;
  }

  bool edit(const std::string& name, const Mesh& mesh, Json& row) {
    const bool has_few = is_large(mesh);
    const std::size_t edits = has_few ? options_.edits_on_large : options_.edits;
    Edit_tally tally;
    for (std::size_t done = 0; done < edits; done += options_.edit_batch)
      if (is_ours())
        tally += made(mesh, std::min(options_.edit_batch, edits - done), has_few, &Broad_phase_choice::edit_batch);
    if (tally.edits == 0)
      return false;
    edits_ += tally;
    row["mixed_edits"] = tally.json();
    std::cout << name << ": " << tally.edits << " mixed edits, " << tally.done() << " done, "
              << tally.creations_wrongly_refused << " of " << tally.feasible_creations()
              << " feasible creations refused, " << tally.creations_wrongly_accepted << " infeasible accepted of "
              << tally.creations_judged << " judged, " << tally.undo_differs << " differ undone, " << tally.redo_differs
              << " redone, " << tally.invalid << " invalid of " << tally.validations << '\n'
              << std::flush;
    return true;
  }

  void add_promises(benchmark::Promises& promises) const {
    const std::size_t files = shard_.is_first() ? files_read_ : 0; // every share reads all
    promises.add(not_embedded, "the mesh is embedded", drags_.validations + edits_.validations + extremes_.drags,
                 drags_.invalid + edits_.invalid + extremes_.invalid);
    promises.add(not_finite, "all coordinates are finite", extremes_.drags, extremes_.not_finite);
    promises.add(moved_though_refused, "what is refused moves nothing", extremes_.refused,
                 extremes_.moved_though_refused);
    promises.add(went_away, "no drag ends farther from its target", extremes_.drags, extremes_.farther);
    promises.add(contradiction, "no result contradicts itself", drags_.drags + extremes_.drags,
                 drags_.contradictions + extremes_.contradictions);
    promises.add(other_bits, "every broad phase gives the same bits", all_counts_.compared,
                 all_counts_.other_bits);
    promises.add(jumped_over, "no creation crosses the surface", edits_.creations_judged,
                 edits_.creations_wrongly_accepted);
    promises.add(mesh_changed, "nothing moves but what is in hand", drags_.validations + edits_.validations,
                 drags_.changed + edits_.changed);
    promises.add(undo_differs, "undone, all is as it was, bit for bit", edits_.histories, edits_.undo_differs);
    promises.add(redo_differs, "redone, all is as it was, bit for bit", edits_.histories, edits_.redo_differs);
    promises.add(wrongly_accepted, "what has to be refused is refused", files,
                 shard_.is_first() ? wrongly_accepted_ : 0);
    promises.add(wrongly_refused, "what has to be accepted is accepted", options_.refuse.empty() ? 0 : files,
                 shard_.is_first() ? wrongly_refused_ : 0);
    // Where parts of a star are a few ulps apart, a way to a rounded place just before the contact may be blocked. A
    // slide looks on from there, the others stay.
    promises.add(lazy_long, "a push through the object comes near the contact", drags_.through_asked,
                 drags_.through_lazy, response_ == Response::slide ? 0 : 1e-3);
    promises.add(lazy_long, "a push through the object that stays names what holds it", drags_.through_stayed,
                 drags_.through_unexplained, 1e-2);
    promises.add(lazy_short, "short drags of ordinary meshes arrive", drags_.short_asked,
                 drags_.short_asked - drags_.short_arrived, 0.05);
    promises.add(lazy_creation, "feasible creations are made", edits_.feasible_creations(),
                 edits_.creations_wrongly_refused, 0.01);
    promises.add_unwritten(benchmark::cannot_write, all_counts_.unwritten);
  }
};

} // namespace haptic_sculpt::robustness
