#include <string_view>

#include <restir_embedded.h>

#include <own.spv.h>

size_t standardShadeWords();

int main() {
    const uint32_t spirvMagic = 0x07230203;
    bool replaced = false;
    for (const restir::ShaderPack::Module& module : kEmbeddedPack.modules) {
        if (module.wordCount == 0 || module.words[0] != spirvMagic) return 1;
        if (module.pass == std::string_view("di.shade")) replaced = module.wordCount != standardShadeWords();
    }
    return replaced && k_own_spv[0] == spirvMagic ? 0 : 1;
}
