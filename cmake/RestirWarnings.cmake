add_library(restir_warnings INTERFACE)
add_library(restir::warnings ALIAS restir_warnings)
if(MSVC)
    target_compile_options(restir_warnings INTERFACE /W4 $<$<BOOL:${RESTIR_WERROR}>:/WX>)
else()
    # Descriptions are values with defaults, of which a caller names only some.
    target_compile_options(restir_warnings INTERFACE
        -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wno-missing-field-initializers
        $<$<BOOL:${RESTIR_WERROR}>:-Werror>)
endif()
