// Which thread of a ScenePass this is: of compute or, with SCENE_RAYGEN, a ray generation shader.
#ifndef SAMPLES_THREAD_GLSL
#define SAMPLES_THREAD_GLSL
#ifdef SCENE_RAYGEN
#extension GL_EXT_ray_tracing : require

uvec2 sceneThread() { return gl_LaunchIDEXT.xy; }
uint sceneThreadIndex() { return gl_LaunchIDEXT.y * gl_LaunchSizeEXT.x + gl_LaunchIDEXT.x; }

#else

layout(local_size_x = 8, local_size_y = 8) in;

uvec2 sceneThread() { return gl_GlobalInvocationID.xy; }
uint sceneThreadIndex() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
}

#endif
#endif
