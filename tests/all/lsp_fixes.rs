//! Quick fixes of the language server for misspelt names.
use crate::lsp_client::{self, Client};
use serde_json::{Value, json};

/// Misspelt names of settings: machine, dialect, rule and key, in the settings file and in a comment of the program.
#[test]
fn the_nearest_name_of_a_setting_is_offered() {
    let mut client = Client::start(&json!({}));
    for (uri, text, wrong, meant) in [
        (
            "untitled:/a/trunnion.toml",
            "machin = \"mill-3axis\"\n",
            "machin",
            "machine",
        ),
        (
            "untitled:/b/trunnion.toml",
            "machine = \"mill-3axs\"\n",
            "mill-3axs",
            "mill-3axis",
        ),
        (
            "untitled:/c/trunnion.toml",
            "dialect = \"linuxnc\"\n",
            "linuxnc",
            "linuxcnc",
        ),
        (
            "untitled:/d/trunnion.toml",
            "[rules]\npole-flop = \"allow\"\n",
            "pole-flop",
            "pole-flip",
        ),
        (
            "untitled:/m.nc",
            "(trunnion: machine mikron-ucp71)\nG0 X1\nM30\n",
            "mikron-ucp71",
            "mikron-ucp710",
        ),
        (
            "untitled:/l.nc",
            "(trunnion: dialect linuxnc)\nG0 X1\nM30\n",
            "linuxnc",
            "linuxcnc",
        ),
        (
            "untitled:/r.nc",
            "(trunnion: allow pole-flop because I look)\nG0 X1\nM30\n",
            "pole-flop",
            "pole-flip",
        ),
    ] {
        client.open(uri, text);
        // a settings file has no status
        let diagnostics = if uri.contains("toml") {
            client.first_diagnostics(uri, 1)
        } else {
            client.diagnostics(uri, 1)
        };
        let named = |d: &&Value| {
            d["message"]
                .as_str()
                .is_some_and(|message| message.contains("did you mean"))
        };
        let own = diagnostics
            .iter()
            .find(named)
            .unwrap_or_else(|| panic!("{text}: {diagnostics:?}"));
        let ask = json!({ "textDocument": { "uri": uri }, "range": own["range"], "context": { "diagnostics": [own] } });
        let answer = client.request("textDocument/codeAction", ask);
        let actions = answer["result"].as_array().expect("a list");
        let title = format!("write {meant}");
        let action = actions.iter().find(|action| action["title"] == title.as_str());
        let action = action.unwrap_or_else(|| panic!("{wrong}: {actions:?}"));
        let edit = &action["edit"]["changes"][uri][0];
        assert_eq!(edit["newText"], meant);
        assert_eq!(lsp_client::text_of(text, &edit["range"]), wrong, "{text}");
    }
    client.finish();
}
