// The default bridge: nothing replaced. A host's directory earlier on the include path brings its own file of this name.
#include "restir/bridge/standard.glsl"
