#include <restir/restir.h>

int main() {
    const restir::DeviceNeeds needs = restir::deviceNeeds(restir::RayBackend::RayQuery);
    return needs.extensions.empty() ? 1 : 0;
}
