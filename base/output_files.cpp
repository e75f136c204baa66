#include "base/output_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>

#include "base/alarm.h"
#include "base/console.h"
#include "base/file_handle.h"
#include "base/waiting.h"

namespace trunnion::inline base {
namespace fs = std::filesystem;
namespace {

/// The first part of `folder` that is missing or is no folder; empty if all are folders.
std::string fault_of_folder(const fs::path& folder) {
    fs::path part;
    for (const fs::path& name : folder) {
        part /= name;
        std::error_code unknown;
        const fs::file_status status = fs::status(part, unknown);
        if (!fs::exists(status) && status.type() == fs::file_type::not_found)
            return "there is no folder '" + part.string() + "'";
        if (fs::exists(status) && !fs::is_directory(status))
            return "'" + part.string() + "' is a file, not a folder";
    }
    return {};
}

[[noreturn]] void refuse(const std::string& path, int error) {
    const bool of_folder = error == ENOENT || error == ENOTDIR;
    const std::string fault = of_folder ? fault_of_folder(fs::path(path).parent_path()) : "";
    throw InputError("cannot be written: " + (fault.empty() ? system_reason(error) : fault),
                     {path, 0, 0});
}

/// Blocks signals that end a process during its lifetime.
class HeldSignals {
  public:
    HeldSignals() {
        sigset_t ending;
        ::sigemptyset(&ending);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) ::sigaddset(&ending, signal);
        ::pthread_sigmask(SIG_BLOCK, &ending, &before_);
    }
    ~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

  private:
    sigset_t before_;
};

/// The file behind all symbolic links, even if the last link points to a missing file.
std::string behind_links(std::string path) {
    for (int links = 0; links < 40; ++links) {
        std::error_code none;
        const fs::path target = fs::read_symlink(path, none);
        if (none) return path;
        path = (fs::path(path).parent_path() / target).string();  // an absolute target replaces the
                                                                  // whole path
    }
    refuse(path, ELOOP);
}

std::string folder_of(const std::string& path) {
    const std::string folder = fs::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

std::string name_beside(const std::string& path, unsigned attempt) {
    const std::string name = fmt::format(".trunnion_{}_{}", ::getpid(), attempt);
    return (fs::path(folder_of(path)) / name).string();
}

constexpr unsigned most_attempts = 10000;  ///< number of names tried next to the target
constexpr int most_open = 200;             ///< number of descriptors; beyond it complete files are
                                           ///< closed

/// Calls `make` with names next to `path` until one is free. False on any other failure, see errno.
template <typename Make>
bool with_free_name(const std::string& path, std::string& name, Make make) {
    for (unsigned attempt = 0; attempt < most_attempts; ++attempt) {
        name = name_beside(path, attempt);
        if (make(name.c_str())) return true;
        if (errno != EEXIST) return false;
    }
    return false;
}

std::string link_of(int descriptor) {
    return fmt::format("/proc/self/fd/{}", descriptor);
}

}  // namespace

struct OutputFile::State {
    std::string path;    ///< as given by the user
    std::string target;  ///< with links resolved
    std::string name;    ///< of the unpublished file; empty: it has no name
    FileHandle file;
    bool direct = false;    ///< a device or a pipe
    bool replaces = false;  ///< there is a file already
    struct stat replaced {};

    void open_direct(const struct stat& existing);
    void open_pipe();
    void open_unnamed();
    void open_named();
    void keep_owner_and_mode();
    void sync();
    void give_name();
};

void OutputFile::State::open_direct(const struct stat& existing) {
    direct = true;
    struct stat out {};
    const bool is_out = ::fstat(STDOUT_FILENO, &out) == 0 && out.st_dev == existing.st_dev &&
                        out.st_ino == existing.st_ino && !S_ISREG(existing.st_mode);
    if (!is_out && S_ISFIFO(existing.st_mode)) return open_pipe();
    file = FileHandle(is_out ? ::dup(STDOUT_FILENO)
                             : ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
    if (!file.is_open()) refuse(path, errno);
}

/// Waits for a reader, but not for ever.
void OutputFile::State::open_pipe() {
    for (Wait wait;;) {
        file = FileHandle(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK));
        if (file.is_open()) break;
        if (errno != ENXIO) refuse(path, errno);
        if (!wait.step(-1, 0, true))
            throw InputError("cannot be written: nobody reads this pipe (" + wait.reason() + ")",
                             {path, 0, 0});
    }
    const int flags = ::fcntl(file.descriptor(), F_GETFL);
    if (flags < 0 || ::fcntl(file.descriptor(), F_SETFL, flags & ~O_NONBLOCK) != 0)
        refuse(path, errno);
}

void OutputFile::State::open_unnamed() {
    file = FileHandle(::open(folder_of(target).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
    if (file.is_open() && ::access(link_of(file.descriptor()).c_str(), F_OK) != 0)
        file = FileHandle();
}

void OutputFile::State::open_named() {
    const HeldSignals held;
    const bool made = with_free_name(target, name, [&](const char* free) {
        file = FileHandle(::open(free, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
        return file.is_open();
    });
    if (made) return;
    name.clear();
    refuse(path, errno);
}

/// Gives the new file the owner, the group and the mode of the one that it replaces. An owner that
/// the system does not let the user give stays the user; the file then runs as nobody else.
void OutputFile::State::keep_owner_and_mode() {
    const int f = file.descriptor();
    struct stat own {};
    if (::fstat(f, &own) != 0) refuse(path, errno);
    const bool kept = (own.st_uid == replaced.st_uid && own.st_gid == replaced.st_gid) ||
                      ::fchown(f, replaced.st_uid, replaced.st_gid) == 0 ||
                      (::fchown(f, static_cast<uid_t>(-1), replaced.st_gid) == 0 &&
                       own.st_uid == replaced.st_uid);
    const mode_t mode = replaced.st_mode & (kept ? 07777U : 0777U);
    if (::fchmod(f, mode) != 0) refuse(path, errno);
}

void OutputFile::State::sync() {
    if (replaces) keep_owner_and_mode();
    // Some file systems do not support synchronisation and report that.
    if (::fsync(file.descriptor()) != 0 && errno != EINVAL && errno != ENOTSUP) refuse(path, errno);
}

void OutputFile::State::give_name() {
    const std::string unnamed = link_of(file.descriptor());
    if (with_free_name(target, name, [&](const char* free) {
            return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, free, AT_SYMLINK_FOLLOW) == 0;
        }))
        return;
    name.clear();
    refuse(path, errno);
}

OutputFile::OutputFile(std::string path) : state_(std::make_unique<State>()) {
    state_->path = std::move(path);
    struct stat existing {};
    if (::stat(state_->path.c_str(), &existing) == 0) {
        if (S_ISDIR(existing.st_mode))
            throw InputError("is a folder, not a file", {state_->path, 0, 0});
        if (!S_ISREG(existing.st_mode)) {
            state_->open_direct(existing);
            return;
        }
        if (::access(state_->path.c_str(), W_OK) != 0) refuse(state_->path, errno);
        state_->replaces = true;
        state_->replaced = existing;
    } else if (errno != ENOENT) {
        refuse(state_->path, errno);
    }
    state_->target = behind_links(state_->path);
    state_->open_unnamed();
    if (!state_->file.is_open()) state_->open_named();
}

OutputFile::~OutputFile() {
    if (!state_->name.empty()) ::unlink(state_->name.c_str());
}

const std::string& OutputFile::path() const {
    return state_->path;
}

void OutputFile::append(std::string_view text) {
    if (!write_all(state_->file.descriptor(), text)) refuse(state_->path, errno);
}

void OutputFile::complete() {
    if (!state_->direct) state_->sync();
    const bool named_early = !state_->direct && state_->file.descriptor() > most_open;
    if (named_early && state_->name.empty()) state_->give_name();
    if ((state_->direct || named_early) && !state_->file.close()) refuse(state_->path, errno);
}

void OutputFile::give_name() {
    if (state_->direct) return;
    const HeldSignals held;
    if (state_->name.empty()) state_->give_name();
    if (!state_->file.close()) refuse(state_->path, errno);
}

void OutputFile::publish() {
    if (state_->direct) return;
    const HeldSignals held;
    give_name();
    if (::rename(state_->name.c_str(), state_->target.c_str()) != 0) refuse(state_->path, errno);
    state_->name.clear();
}

OutputFiles::~OutputFiles() {
    files_.clear();
    for (auto path = made_.rbegin(); path != made_.rend(); ++path) ::rmdir(path->c_str());
}

void OutputFiles::add_folder(const std::string& path) {
    if (path.empty()) return;  // our own object
    fs::path folder;
    for (const fs::path& name : fs::path(path)) {
        folder /= name;
        std::error_code error;
        if (name.empty()) continue;  // of a slash at the end
        if (fs::create_directory(folder, error)) made_.push_back(folder.string());
        if (!error) continue;
        const std::string fault = error == std::errc::file_exists ? fault_of_folder(folder) : "";
        throw InputError("this folder cannot be made: " + (fault.empty() ? error.message() : fault),
                         {path, 0, 0});
    }
    if (::access(path.c_str(), W_OK | X_OK) != 0) refuse(path, errno);
}

void OutputFiles::add(const std::string& path, std::string text) {
    texts_.emplace_back(path, std::move(text));
}

OutputFile& OutputFiles::open(const std::string& path) {
    if (path == "-") throw InputError("this output needs a file", {path, 0, 0});
    return *files_.emplace_back(std::make_unique<OutputFile>(path));
}

void OutputFiles::write() {
    for (const auto& file : files_) file->complete();
    for (const auto& [path, text] : texts_) {
        if (path == "-") continue;
        open(path).append(text);
        files_.back()->complete();
    }
    for (const auto& [path, text] : texts_)
        if (path == "-") write_out(text);
    finish_out();
    const HeldSignals held;
    for (const auto& file : files_) file->give_name();  // what may fail, first
    for (const auto& file : files_) file->publish();
    files_.clear();
    texts_.clear();
    made_.clear();
}

void write_output(const std::string& path, std::string text) {
    OutputFiles files;
    files.add(path, std::move(text));
    files.write();
}

}  // namespace trunnion::inline base
