// SPDX-License-Identifier: GPL-3.0-or-later
#include "Log_file.h"

#include "contents_of.h"
#include "write_file.h"

#include <haptic_sculpt/surface/Write_error.h>

#include <cerrno>
#include <cstring>
#include <new>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace haptic_sculpt::examples {
namespace {

std::string in_words(const std::string& path) {
  return "the log '" + path + "'";
}
std::string system_says() {
  return std::strerror(errno);
}

} // namespace

Log_file::Log_file(const std::string& path, const std::string& mesh)
    : path_(path), mesh_(mesh), target_(follow_links(path)) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (const std::string why = why_not_writable(target_); !why.empty())
      throw Write_error("cannot make " + in_words(path) + ": " + why);
    return; // made when the work begins
  }
  if (!S_ISREG(status.st_mode)) // asked before it is opened: opening a device may do something, and a pipe waits
    throw Write_error(in_words(path) + " cannot be a folder, a device or a pipe: it is read again later; name a file");
  file_ = ::open(target_.c_str(), O_RDWR | O_APPEND | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (file_ < 0)
    throw Write_error("cannot open " + in_words(path) + " for appending: " + system_says() +
                      "; to replay it only, give it to sculpt as a script (sculpt --script)");
  try {
    lock();
    std::string text;
    read_to_end<Write_error>(file_, in_words(path_), [&](std::string_view block) {
      if (text.empty()) // before a file that is none, of any size, is read
        check_begin_of_log(block, path_);
      text += block;
    });
    if (!text.empty())
      contents_ = read_log(text, path_, mesh_);
    if (!contents_) {
      size_ = static_cast<off_t>(text.size());
      part_of_head_ = std::move(text);
      return;
    }
    writer_ = contents_->writer;
    size_ = static_cast<off_t>(contents_->whole_size);
  } catch (...) { // no destructor closes it: there is no object yet
    ::close(file_);
    throw;
  }
}

Log_file::~Log_file() {
  if (file_ >= 0)
    ::close(file_);
}

void Log_file::lock() const {
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
    throw Write_error(errno == EWOULDBLOCK
                          ? in_words(path_) +
                                " is in use by another process; wait until it has ended, or give another log"
                          : "cannot lock " + in_words(path_) + ": " + system_says());
  if (!is_at_its_path())
    throw Write_error(in_words(path_) + " has just been replaced by another process; try again");
}

void Log_file::begin(const Settings& settings) {
  if (contents_) {
    if (!contents_->unfinished.empty() && ::ftruncate(file_, size_) != 0)
      throw Write_error("cannot cut the unfinished last line off " + in_words(path_) + ": " + system_says());
    return;
  }
  const std::string head = writer_.head(mesh_, settings);
  if (head.compare(0, part_of_head_.size(), part_of_head_) != 0)
    throw Foreign_log(in_words(path_) + " lacks a whole head, and is not the beginning of the head that this command "
                      "would write; it is left as it is: give another name, or the options it was begun with");
  const bool is_made = file_ < 0;
  if (is_made) {
    file_ = ::open(target_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    const auto begun_by_another = [&] {
      return Write_error(in_words(path_) +
                         " has just been begun by another process; wait until it has ended, or give another log");
    };
    if (file_ < 0 && errno == EEXIST)
      throw begun_by_another();
    if (file_ < 0 && (errno == ENOSPC || errno == EDQUOT)) {
      fail(std::strerror(errno));
      return;
    }
    if (file_ < 0)
      throw Write_error("cannot make " + in_words(path_) + ": " + system_says());
    lock();
    // Another process may have found the file empty before it was locked here, begun it, and ended already.
    if (struct stat status {}; ::fstat(file_, &status) != 0 || status.st_size != 0)
      throw begun_by_another();
  }
  write(head.substr(part_of_head_.size())); // in one write: only a process that is killed leaves a part
  if (is_made && !failure_.empty())
    remove();
}

void Log_file::drop_unfinished_tick() {
  if (!contents_ || !contents_->last_tick)
    return;
  if (contents_->last_tick->end.size != contents_->whole_size)
    cut_to(contents_->last_tick->end, "a tick");
}

void Log_file::drop_last_line() {
  contents_->passes.back().last_line = contents_->last_line->before;
  cut_to(contents_->last_line->begin, "a move without its end, which the script makes again");
  contents_->last_line.reset();
}

void Log_file::cut_to(const Log_contents::Place& place, const char* what) {
  contents_->commands.resize(place.commands);
  contents_->unfinished = what; // begin() cuts it off
  size_ = static_cast<off_t>(contents_->whole_size = place.size);
  writer_ = contents_->writer = Log_writer(place.checksum);
}

void Log_file::append(const Command& command) {
  append_made([&] { return writer_.command(command, command.line); });
}

void Log_file::append_tick(const std::vector<Command>& commands, std::size_t tick) {
  append_made([&] {
    std::string lines;
    for (const Command& command : commands)
      lines += writer_.command(command, tick != 0 ? tick : 1);
    return lines + writer_.tick(tick);
  });
}

void Log_file::begin_pass(const std::string& script, std::size_t after) {
  append_made([&] {
    std::string lines;
    if (contents_)
      lines += writer_.ends(open_strokes(contents_->commands));
    return lines + writer_.pass(script, after);
  });
}

void Log_file::end_pass(const std::string& script) {
  append_made([&] { return writer_.done(script); });
}

template <class Lines>
void Log_file::append_made(const Lines& lines) {
  if (!failure_.empty())
    return;
  try {
    write(lines());
  } catch (const std::bad_alloc&) {
    fail(no_memory);
  }
}

void Log_file::write(const std::string& lines) {
  if (struct stat now{}; ::fstat(file_, &now) != 0 || now.st_size != size_ || !is_at_its_path())
    return fail("it was moved away, or changed, while it was written");
  for (std::size_t done = 0; done < lines.size();) {
    const ssize_t written = ::write(file_, lines.data() + done, lines.size() - done);
    if (written < 0 && errno != EINTR) {
      fail(std::strerror(errno));
      if (::ftruncate(file_, size_) != 0)
        failure_ += " (and part of a line is left, which the next run drops)";
      return;
    }
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  size_ += static_cast<off_t>(lines.size());
}

void Log_file::remove() {
  if (file_ >= 0 && is_at_its_path())
    ::unlink(target_.c_str());
}

bool Log_file::is_at_its_path() const {
  struct stat here {
  }, there{};
  return ::fstat(file_, &here) == 0 && ::stat(target_.c_str(), &there) == 0 && here.st_ino == there.st_ino &&
         here.st_dev == there.st_dev;
}

void Log_file::fail(const char* why) {
  try {
    failure_ = "cannot append to " + in_words(path_) + ": " + why;
  } catch (const std::bad_alloc&) {
    failure_ = "no room in log"; // short enough to be in the object itself
  }
  has_failed_ = true; // last: whoever asks may read the reason then
}

} // namespace haptic_sculpt::examples
