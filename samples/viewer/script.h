// A file that does what a user would: one command a line, # begins a comment.
//
//     set NAME=VALUE...       settings as on the command line, preset=NAME among them
//     debug VIEW|off          split on|off    measure on|off    panels on|off    denoise on|off
//     line X                  where the split is, in [0, 1]
//     exposure STOPS|auto     scale X         window WxH
//     scene NAME              camera INDEX    fly RIGHT UP FORWARD    orbit DEGREES
//     animate NAME|off
//     rays query|pipeline|software     how the library traces
//     frames N                go on for so many frames
//     shot FILE.png|FILE.exr  the picture     panelshot FILE.png      the window
#pragma once

#include <string>
#include <vector>

#include "viewer/stage.h"
#include "viewer/state.h"

namespace viewer {

class Script {
public:
    // Throws std::runtime_error naming file and line.
    explicit Script(const std::string& path);

    // Before each frame; false: the file has come to its end, and the next call begins it anew.
    bool step(State& state, const Stage& stage);

private:
    struct Command {
        size_t line = 0;
        std::string name, argument;
    };

    void run(const Command& command, State& state, const Stage& stage);

    std::string path_;
    std::vector<Command> commands_;
    size_t next_ = 0;
    uint32_t frames_ = 0;         // still to go
    uint32_t compilations_ = 0;   // to wait for
};

}   // namespace viewer
