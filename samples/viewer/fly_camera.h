// A camera that flies: keys move it, the mouse turns it.
#pragma once

#include "common/scene.h"

namespace viewer {

// What a user asks of it in a frame.
struct Flight {
    glm::vec3 move{0};   // right, up, forward; in [-1, 1]
    glm::vec2 turn{0};   // radians to the right and up
    float haste = 1;     // factor on the speed
};

class FlyCamera {
public:
    // Starts at `view`, at a speed that suits what it looks at.
    void place(const samples::View& view);
    void fly(const Flight& flight, float seconds);
    // About what it looks at, in radians to the left.
    void orbit(float angle);

    const samples::View& view() const { return view_; }
    float speed = 1;   // metres a second

private:
    samples::View view_;
};

}   // namespace viewer
