// SPDX-License-Identifier: GPL-3.0-or-later
#include "Sculpting_thread.h"

#include "Hand.h"

#include <haptic_sculpt/haptic_rendering/Tick_statistics.h>

#include <cerrno>
#include <cstring>
#include <ctime>

namespace haptic_sculpt::window_program {
namespace {

constexpr std::uint64_t tick_time = 1000000; // ns

std::uint64_t now() {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1000000000u + static_cast<std::uint64_t>(time.tv_nsec);
}
void wait_until(std::uint64_t due) {
  const timespec until{static_cast<std::time_t>(due / 1000000000u), static_cast<long>(due % 1000000000u)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR)
    ;
}

Percentiles percentiles_of(const Tick_statistics& times) {
  return {times.percentile(0.5), times.percentile(0.99), times.percentile(0.999), times.largest()};
}

} // namespace

struct Sculpting_thread::Parts {
  static constexpr std::size_t faces_a_tick = 1000;
  static constexpr std::size_t copied_a_tick = 1000; ///< elements, about 30 microseconds

  boost::lockfree::spsc_queue<Request> requests{1024};
  boost::lockfree::spsc_queue<Face_change> changes{std::size_t(1) << 16};
  boost::lockfree::spsc_queue<Report> reports{256};
  Latest<Status> latest;
  std::atomic<bool> ends{false};
  // The window's:
  std::uint64_t asked = 0;
  std::uint32_t entered = 0;                           ///< models
  std::size_t entered_vertices = 0, entered_faces = 0; ///< slots of the last of them

  // The loop's:
  Model* model = nullptr;
  std::optional<Hand> hand;
  Scene_copy* copying = nullptr; ///< under way
  Status status;
  Tick_statistics work, lateness;
  std::thread thread;

  void say(Report::Kind kind, const std::string& text) {
    Report report;
    report.kind = kind;
    std::strncpy(report.text.data(), text.c_str(), report.text.size() - 1);
    const std::size_t spare = 16; // for what must not be lost
    if (reports.write_available() > spare)
      reports.push(report); // else the window has 240 messages to show already
  }

  void answer(const Request& request) {
    if (request.kind == Request::Kind::enter)
      enter(request.model);
    else if (hand)
      carry_out(request);
    status.answered = request.number;
  }

  void enter(Model* next) {
    if (hand)
      hand->let_go();
    while (copying != nullptr) // what was asked for comes: nobody's hand is there to wait for the tick
      copy_on();
    hand.reset();
    if (model != nullptr) {
      Report report;
      report.kind = Report::Kind::left, report.model = model;
      reports.push(report);
    }
    model = next;
    status = Status();
    status.scene = ++scenes;
    if (model != nullptr)
      hand.emplace(*model);
  }
  std::uint32_t scenes = 0;

  void carry_out(const Request& request) {
    std::string refused;
    switch (request.kind) {
    case Request::Kind::point:
      hand->point(request);
      break;
    case Request::Kind::press:
      refused = hand->press(request);
      break;
    case Request::Kind::let_go:
      hand->let_go();
      break;
    case Request::Kind::flip:
      refused = hand->flip(request);
      break;
    case Request::Kind::collapse:
      refused = hand->collapse(request);
      break;
    case Request::Kind::undo:
      refused = hand->undo();
      break;
    case Request::Kind::redo:
      refused = hand->redo();
      break;
    case Request::Kind::response:
      model->sculptor->set_response(request.response == 0 ? Response::slide : Response::stop);
      break;
    case Request::Kind::copy:
      copying = request.copy;
      copying->begin();
      model->sculptor->visitor().tell_to(copying);
      break;
    default:
      break;
    }
    if (!refused.empty())
      say(Report::Kind::refused, refused);
  }

  /// A part of the copy under way. The hand goes on meanwhile, and what it changes is in the copy, too.
  void copy_on() {
    if (copying == nullptr || !copying->copy_some(*model->sculptor, Vertex_index(), copied_a_tick))
      return;
    model->sculptor->visitor().tell_to(static_cast<Scene_copy*>(nullptr));
    Report report;
    report.kind = Report::Kind::copied, report.copy = std::exchange(copying, nullptr), report.edits = model->edits;
    reports.push(report);
  }

  void tell_faces() {
    for (std::size_t i = 0; i < faces_a_tick && model->dirty.size() > 0; ++i) {
      Face_change change = model->face(model->dirty.front());
      change.scene = status.scene;
      if (!changes.push(change))
        return; // told later, as it is then
      model->dirty.pop();
    }
  }

  void tick() {
    for (Request request; requests.pop(request);) {
      answer(request);
      if (request.kind != Request::Kind::point)
        break; // one edit a tick; of motions the last counts
    }
    if (!hand)
      return;
    hand->move();
    copy_on();
    tell_faces();
    hand->tell(status);
  }

  void run() {
    std::uint64_t due = now();
    while (!ends) {
      const std::uint64_t begin = now();
      lateness.add(begin > due ? begin - due : 0);
      try {
        tick();
      } catch (const Error& error) { // such as a target out of range: the mesh is as it was
        say(Report::Kind::refused, error.what());
        if (hand)
          hand->let_go();
      }
      const std::uint64_t end = now();
      work.add(end - begin);
      ++status.ticks;
      status.missed_by_work += end - begin > tick_time;
      status.woken_late += begin > due + tick_time;
      if (status.ticks % 256 == 1)
        status.work = percentiles_of(work), status.lateness = percentiles_of(lateness);
      latest.put(status);
      due += tick_time;
      if (due + 20 * tick_time < end)
        due = end; // what was missed is not made up for
      wait_until(due);
    }
    if (hand)
      hand->let_go();
  }
};

Sculpting_thread::Sculpting_thread() : parts_(std::make_unique<Parts>()) {
  parts_->thread = std::thread([this] { parts_->run(); });
}

Sculpting_thread::~Sculpting_thread() {
  parts_->ends = true;
  parts_->thread.join();
  delete parts_->copying;
  parts_->hand.reset();
  destroy(parts_->model, true);
}

std::uint64_t Sculpting_thread::ask(Request request) {
  request.number = parts_->asked + 1;
  std::unique_ptr<Scene_copy> copy;
  if (request.kind == Request::Kind::copy) {
    // While it is filled, and while this request waits, each tick may create a vertex, and two faces with it.
    std::size_t vertices = parts_->entered_vertices, faces = parts_->entered_faces;
    if (const Status& now = status(); now.scene == parts_->entered)
      vertices = std::max(vertices, now.vertex_slots), faces = std::max(faces, now.face_slots);
    const std::size_t ticks = (vertices + faces) / Parts::copied_a_tick + 2048;
    copy = std::make_unique<Scene_copy>(vertices + ticks, faces + 2 * ticks);
    request.copy = copy.get();
  }
  Mesh::size_type vertices = 0, faces = 0; // of a model: once it is handed over it is the loop's
  if (request.kind == Request::Kind::enter && request.model != nullptr)
    vertices = request.model->mesh.num_vertices(), faces = request.model->mesh.num_faces();
  if (!parts_->requests.push(request))
    return 0;
  copy.release();
  if (request.kind == Request::Kind::enter)
    ++parts_->entered, parts_->entered_vertices = vertices, parts_->entered_faces = faces;
  return ++parts_->asked;
}
const Status& Sculpting_thread::status() {
  return parts_->latest.get();
}
bool Sculpting_thread::take(Face_change& change) {
  return parts_->changes.pop(change);
}
bool Sculpting_thread::take(Report& report) {
  return parts_->reports.pop(report);
}

Opened open(const std::string& path, const std::string& log) {
  std::unique_ptr<Model> model = open_model(path, log);
  Opened opened;
  opened.path = path, opened.log = log;
  opened.resumed = model->resumed;
  opened.faces.reserve(model->mesh.num_faces());
  for (std::uint32_t f = 0; f < model->mesh.num_faces(); ++f)
    opened.faces.push_back(model->face(f));
  opened.model = model.release();
  return opened;
}

void destroy(Model* model, bool keeps_log) {
  if (model == nullptr)
    return;
  std::string log;
  if (model->log) {
    model->log->close();
    log = keeps_log ? "" : model->log->path();
  }
  delete model;
  if (!log.empty())
    std::remove(log.c_str());
}

std::string write_and_destroy(Scene_copy* copy, const std::string& path) {
  return write_copy(*std::unique_ptr<Scene_copy>(copy), path);
}

} // namespace haptic_sculpt::window_program
