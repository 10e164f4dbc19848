#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// A program that runs beside this one, with nothing to read. It is ended, with all that it started, when this object
/// goes, and when the thread that made it ends.
class RunningProgram {
public:
    /// `arguments`: the first its path. What it prints goes into `output`, its errors into `errors`; both files are
    /// made anew. Fails with MachineError if a file cannot be made or the program cannot be started.
    RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                   const std::filesystem::path& errors);
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    /// Its exit code once it has ended; of one that a signal ended 128 and that. Does not wait.
    std::optional<int> exit_code();

private:
    int process_ = -1;
    std::optional<int> exit_code_;
};
