#include "viewer/input.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "common/setting_options.h"

namespace viewer {
namespace {

constexpr float kTurnPerPixel = 0.004f;   // radians
constexpr float kLongestStep = 0.25f;     // seconds: slow frames are no leaps
constexpr float kLineGrip = 6;            // pixels to each side of the split

void flyAbout(State& state, const Window& window) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto held = [&](int positive, int negative) {
        return (window.isDown(positive) ? 1.0f : 0.0f) - (window.isDown(negative) ? 1.0f : 0.0f);
    };
    Flight flight;
    if (!io.WantCaptureKeyboard) {
        flight.move = {held(GLFW_KEY_D, GLFW_KEY_A), held(GLFW_KEY_E, GLFW_KEY_Q),
                       held(GLFW_KEY_W, GLFW_KEY_S)};
        flight.haste = io.KeyShift ? 4.0f : 1.0f;
    }
    if (!io.WantCaptureMouse) {
        if (ImGui::IsMouseDown(ImGuiMouseButton_Right))
            flight.turn = kTurnPerPixel * glm::vec2(io.MouseDelta.x, -io.MouseDelta.y);
        if (io.MouseWheel != 0) state.camera.speed *= io.MouseWheel > 0 ? 1.25f : 0.8f;
    }
    state.camera.fly(flight, std::min(io.DeltaTime, kLongestStep));
}

// The split's line follows the left button.
void dragLine(State& state) {
    const ImGuiIO& io = ImGui::GetIO();
    bool& dragging = state.draggingLine;
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) dragging = false;
    if (!state.split || io.WantCaptureMouse) return;
    const bool near = std::abs(io.MousePos.x - state.line * io.DisplaySize.x) < kLineGrip;
    if (near || dragging) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (near && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) dragging = true;
    if (dragging) state.line = glm::clamp(io.MousePos.x / io.DisplaySize.x, 0.0f, 1.0f);
}

void press(int key, State& state, const Stage& stage) {
    if (key >= GLFW_KEY_1 && key < GLFW_KEY_1 + int(std::size(kPresets)))
        samples::applyPreset(state.settings, kPresets[key - GLFW_KEY_1].preset);
    switch (key) {
        case GLFW_KEY_F1:
            state.panels = !state.panels;
            break;
        case GLFW_KEY_R:
            state.split = !state.split;
            break;
        case GLFW_KEY_SPACE:
            state.playing = !state.playing;
            break;
        case GLFW_KEY_HOME:
            state.lookThrough(stage.views.front());
            break;
        case GLFW_KEY_F12:
            state.saveScreenshot();
            break;
        case GLFW_KEY_ESCAPE:
            state.quit = !ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId);   // of a list of choices
            break;
    }
}

}   // namespace

const char* keysText() {
    return "W A S D, E Q  fly; with Shift faster\n"
           "right button  look around\n"
           "wheel         speed of flight\n"
           "1 2 3 4       presets, fast to unbiased\n"
           "R             reference in the right half\n"
           "Space         animation\n"
           "Home          the scene's camera\n"
           "F1            panels\n"
           "F12           screenshot, PNG and EXR\n"
           "Esc           quit";
}

void applyInput(State& state, const Stage& stage, Window& window) {
    flyAbout(state, window);
    dragLine(state);
    for (const int key : window.takePressed())
        if (!ImGui::GetIO().WantCaptureKeyboard) press(key, state, stage);
}

}   // namespace viewer
