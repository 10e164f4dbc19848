#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// A program that runs beside this one, without input. It and all that it started end with this object, and with the
/// thread that made it.
class RunningProgram {
public:
    enum class Priority {
        normal,
        background  ///< niceness 19: other programs get the processors first
    };

    /// Starts a program; arguments[0] is its path. Its output goes to `output`, its errors to `errors`; both files are
    /// made anew. Fails with MachineError if a file cannot be made or the program cannot start.
    RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                   const std::filesystem::path& errors, Priority priority = Priority::normal);
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    /// The exit code once the program has ended; 128 + signal if a signal ended it. Does not wait.
    std::optional<int> exit_code();

private:
    int process_ = -1;
    std::optional<int> exit_code_;
};
