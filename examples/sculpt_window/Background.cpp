// SPDX-License-Identifier: GPL-3.0-or-later
#include "Background.h"

#include "Options.h"
#include "Tasks.h"

#include "../common/told_loss.h"
#include "../common/write_file.h"

#include <chrono>
#include <stdexcept>

namespace haptic_sculpt::window_program {
namespace {

template <class Future>
bool is_ready(const Future& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

/// Has a thread of its own do this. Where there can be none, `otherwise` gives the promise what takes its place.
template <class Work, class Otherwise>
auto begun(Work work, const Otherwise& otherwise) {
  try {
    return std::async(std::launch::async, work);
  } catch (const std::exception& error) {
    std::promise<decltype(work())> promise;
    otherwise(promise,
              std::make_exception_ptr(std::runtime_error(std::string("no thread can be made: ") + error.what())));
    return promise.get_future();
  }
}

} // namespace

void Background::open(const std::string& path, const std::string& log) {
  opening_ = begun([path, log] { return window_program::open(path, log); },
                   [](auto& promise, const std::exception_ptr& failure) { promise.set_exception(failure); });
}

std::optional<Opened> Background::take_opened() {
  if (!is_ready(opening_))
    return std::nullopt;
  return opening_.get();
}

void Background::save(const Saved_copy& copy, Saved saved) {
  const auto before = saving_.empty() ? std::shared_future<Saved>() : saving_.back();
  const auto write = [copy, saved, before]() mutable {
    if (before.valid())
      before.wait();
    try {
      saved.lost = write_copy(*copy, saved.path);
    } catch (...) { // handed on to the window's thread, which tells it
      saved.error = std::current_exception();
    }
    return std::move(saved);
  };
  saving_.push_back(begun(write, [&saved](auto& promise, const std::exception_ptr& failure) {
                      saved.error = failure;
                      promise.set_value(saved);
                    }).share());
}

std::optional<Background::Saved> Background::take_saved() {
  if (saving_.empty() || !is_ready(saving_.front()))
    return std::nullopt;
  Saved saved = saving_.front().get();
  saving_.erase(saving_.begin());
  return saved;
}

namespace {

/// What is done about a log that cannot be used depends on who has asked for it.
std::string with_advice(const char* what, const std::string& path, const std::string& log) {
  const bool was_asked_for = log != Options::log_beside(path);
  return std::string(what) + (was_asked_for ? "; --no-log keeps none"
                                            : ". It is the log that the window keeps beside a mesh: --log FILE keeps "
                                              "another one, --no-log none; or move it away");
}

std::unique_ptr<Model> model_of(const std::string& path, const std::string& log) {
  try {
    return std::make_unique<Model>(examples::Mesh_file(path), log);
  } catch (const examples::Foreign_log& error) {
    throw examples::Foreign_log(with_advice(error.what(), path, log));
  } catch (const Write_error& error) {
    throw Write_error(with_advice(error.what(), path, log));
  }
}

} // namespace

Opened open(const std::string& path, const std::string& log) {
  auto model = model_of(path, log);
  Opened opened;
  opened.path = path, opened.log = log;
  opened.resumed = model->resumed, opened.note = model->note;
  opened.middle = place(0.5 * model->lower + 0.5 * model->upper);
  opened.faces.reserve(model->mesh.num_faces());
  for (std::uint32_t f = 0; f < model->mesh.num_faces(); ++f)
    opened.faces.push_back(model->face(f));
  model->sculptor.visitor().changed.clear();
  opened.model.reset(model.release());
  return opened;
}

std::uint64_t number_of_edits(const Model& model) {
  return model.edits;
}

std::string destroy(Model* model, bool keeps_log) {
  model->log.finish();
  std::string failure = model->log.failure();
  if (failure.empty() && model->log.has_overrun())
    failure = "the log '" + model->log_path + "' lacks what was done last: it could not be written as fast as that";
  if (!keeps_log && !model->log.is_of_others())
    model->log.remove();
  delete model;
  return failure;
}

void Destroy_with_log::operator()(Model* model) const {
  destroy(model, true);
}

std::string write_copy(const Save& saved, const std::string& path) {
  const Mesh mesh = saved.mesh();
  std::string lost = examples::write_mesh(path, mesh);
  if (const std::string loss = examples::told_loss(saved.opened, path, mesh, saved.left_out, "is"); !loss.empty())
    lost += (lost.empty() ? "" : "; ") + loss;
  return lost;
}

} // namespace haptic_sculpt::window_program
